/// @file materialNetwork.h
/// HdMaterialNetworkMap -> hipr::MaterialDesc.
#pragma once

#include <optional>

#include "pxr/imaging/hd/material.h"
#include "pxr/pxr.h"
#include "renderer/api/material.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Reads the surface terminal: a UsdPreviewSurface or an OpenPBR Surface (ND_open_pbr_surface_surfaceshader)
/// fed by UsdUVTexture, UsdPrimvarReader_* and UsdTransform2d nodes (UsdPreviewSurface Specification 2.6).
/// Unknown nodes, unsupported connections and cycles are reported once for `materialPath`, and the input
/// keeps its own value. Returns nothing when there is no usable surface.
std::optional<hipr::MaterialDesc> materialDesc(SdfPath const& materialPath,
                                               HdMaterialNetworkMap const& networks);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
