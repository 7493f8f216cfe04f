/// @file surfaces.h
/// The surface shaders of MaterialX as materials of this renderer. docs/materials.md has the mapping.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "renderer/api/material.h"
#include "renderer/materialx/nodes.h"

namespace hipr {

/// The surface node of a network.
struct MtlxSurface {
    GraphBuilder& build;
    std::function<GraphValue(const MtlxInput&)> value; ///< of an input, or its default
    std::function<bool(const char*)> given;            ///< whether the network has the input
    std::function<std::string(const char*)> text;      ///< inputs that are no numbers
    std::function<void(const std::string&)> complain;  ///< says what is wrong with the node
};

/// Sets the model and the inputs of `desc` from a node of the id; false: no surface that is known.
/// Ids: ND_open_pbr_surface_surfaceshader and the names that hosts give it,
/// ND_standard_surface_surfaceshader, ND_gltf_pbr_surfaceshader, ND_UsdPreviewSurface_surfaceshader,
/// UsdPreviewSurface, ND_surface_unlit.
bool mtlxSurface(const std::string& id, const MtlxSurface& surface, MaterialDesc& desc);

} // namespace hipr
