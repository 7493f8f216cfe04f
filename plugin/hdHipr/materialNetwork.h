/// @file materialNetwork.h
/// HdMaterialNetworkMap -> hipr::MaterialDesc.
#pragma once

#include <optional>

#include "pxr/imaging/hd/material.h"
#include "pxr/pxr.h"
#include "renderer/api/material.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The networks of a material; none where it has none.
HdMaterialNetworkMap materialNetworks(HdSceneDelegate& delegate, SdfPath const& material);

/// Reads the surface terminal: a UsdPreviewSurface, or a surface of MaterialX (hipr::mtlxSurface()), fed by
/// the pattern nodes of hipr::mtlxNodes(), USD's own among them (UsdPreviewSurface Specification 2.6).
/// Unknown nodes, unsupported connections and cycles are reported once for `materialPath`, and the input
/// keeps its own value. Returns nothing when there is no usable surface.
std::optional<hipr::MaterialDesc> materialDesc(SdfPath const& materialPath,
                                               HdMaterialNetworkMap const& networks);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
