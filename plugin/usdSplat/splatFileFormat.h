/// @file splatFileFormat.h
/// Captures of splats (.ply, .spz) as layers of USD, read only.
#pragma once

#include "pxr/pxr.h"
#include "pxr/usd/sdf/fileFormat.h"

PXR_NAMESPACE_OPEN_SCOPE

/// `capture.ply` is a layer whose default prim, /Splats, is a ParticleField3DGaussianSplat. The argument `up`
/// (y, -y, z, -z; y by default) tells which axis points up in the capture and becomes Y:
/// `@capture.ply:SDF_FORMAT_ARGS:up=-y@`. How far reading is gets posted as Tf statuses that carry a fraction
/// (double), from half a second on.
class UsdSplatFileFormat : public SdfFileFormat {
public:
    bool CanRead(std::string const& file) const override;
    bool Read(SdfLayer* layer, std::string const& resolvedPath, bool metadataOnly) const override;
    bool WriteToString(SdfLayer const& layer, std::string* text,
                       std::string const& comment = std::string()) const override;
    bool WriteToStream(SdfSpecHandle const& spec, std::ostream& out, size_t indent) const override;

protected:
    SDF_FILE_FORMAT_FACTORY_ACCESS;
    UsdSplatFileFormat();
};

PXR_NAMESPACE_CLOSE_SCOPE
