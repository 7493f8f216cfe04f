/// @file fileFormat.h
/// MaterialX documents (.mtlx) as layers of USD, read only, for an OpenUSD that was built without MaterialX.
#pragma once

#include "pxr/pxr.h"
#include "pxr/usd/sdf/fileFormat.h"

PXR_NAMESPACE_OPEN_SCOPE

/// What a layer holds is told by mtlxLayer(). A document that cannot be opened is an error; what is wrong
/// within one is told and left out, so that the rest can be used.
class HiprMtlxFileFormat : public SdfFileFormat {
public:
    bool CanRead(std::string const& file) const override;
    bool Read(SdfLayer* layer, std::string const& resolvedPath, bool metadataOnly) const override;
    bool ReadFromString(SdfLayer* layer, std::string const& text) const override;
    bool WriteToString(SdfLayer const& layer, std::string* text,
                       std::string const& comment = std::string()) const override;
    bool WriteToStream(SdfSpecHandle const& spec, std::ostream& out, size_t indent) const override;

protected:
    SDF_FILE_FORMAT_FACTORY_ACCESS;
    HiprMtlxFileFormat();
};

PXR_NAMESPACE_CLOSE_SCOPE
