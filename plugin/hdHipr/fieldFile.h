/// @file fieldFile.h
/// Grids of OpenVDB files through ArResolver.
#pragma once

#include <memory>
#include <string>

#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"
#include "renderer/volumes/vdb_reader.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The grid of an asset by its resolved path, or null; what is wrong is said of `field`. While somebody holds
/// the grid of a plain file, it is not read again unless the file was written since. Thread-safe.
std::shared_ptr<const hipr::FieldGrid> fieldGrid(SdfPath const& field, std::string const& path,
                                                 hipr::FieldChoice const& choice);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
