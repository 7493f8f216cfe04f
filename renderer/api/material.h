/// @file material.h
/// Materials as data: every input is a constant, a texture, a primvar or a value of a graph.
#pragma once

#include <map>
#include <tuple>

#include "renderer/api/graph.h"
#include "renderer/api/openpbr.h"

namespace hipr {

enum class OpacityMode : uint32_t { Transparent, Presence };

enum class MaterialModel : uint32_t { UsdPreviewSurface, OpenPbr };

/// How far a material moves the surface, in object space, before anything else is done with it. Evaluated on the host
/// at the corners of triangles, where points of the surface in world space are taken for those in object
/// space, and primvars of instances do not count.
struct Displacement {
    MaterialGraph graph; ///< what `amount` refers to if its source is a graph
    /// A distance along the normal or, for a vector, along the tangent (of the primvar `st`), the bitangent and
    /// the normal.
    MaterialInput amount{MaterialInput::Source::Constant, glm::vec4(0.f), Channel::R, {}, {}};
    bool vector = false;
    /// Whether nothing is moved.
    bool none() const {
        return amount.source == MaterialInput::Source::Constant && glm::vec3(amount.constant) == glm::vec3(0.f);
    }
    auto members() const { return std::tie(graph, amount, vector); }
    bool operator==(const Displacement& o) const { return members() == o.members(); }
};

/// A material of either model; the inputs of the other one are ignored.
struct MaterialDesc {
    std::string name;
    MaterialModel model = MaterialModel::UsdPreviewSurface;

    /// What inputs of MaterialInput::Source::Graph refer to.
    MaterialGraph graph;

    /// The inputs of OpenPBR Surface; those absent have the specification's defaults (openPbrInputs()).
    std::map<OpenPbrInput, MaterialInput> openPbr;

    /// The inputs of UsdPreviewSurface with the specification's defaults (UsdPreviewSurface Specification
    /// 2.6, section "UsdPreviewSurface").
    MaterialInput diffuseColor{
        MaterialInput::Source::Constant, glm::vec4(0.18f, 0.18f, 0.18f, 1.f), Channel::Rgb, {}, {}};
    MaterialInput emissiveColor{};
    MaterialInput specularColor{};
    MaterialInput metallic{};
    MaterialInput roughness{MaterialInput::Source::Constant, glm::vec4(0.5f), Channel::R, {}, {}};
    MaterialInput clearcoat{};
    MaterialInput clearcoatRoughness{MaterialInput::Source::Constant, glm::vec4(0.01f), Channel::R, {}, {}};
    MaterialInput opacity{MaterialInput::Source::Constant, glm::vec4(1.f), Channel::R, {}, {}};
    MaterialInput opacityThreshold{};
    MaterialInput ior{MaterialInput::Source::Constant, glm::vec4(1.5f), Channel::R, {}, {}};
    MaterialInput normal{
        MaterialInput::Source::Constant, glm::vec4(0.f, 0.f, 1.f, 0.f), Channel::Rgb, {}, {}};
    MaterialInput occlusion{MaterialInput::Source::Constant, glm::vec4(1.f), Channel::R, {}, {}};
    bool useSpecularWorkflow = false;
    OpacityMode opacityMode = OpacityMode::Transparent;

    Displacement displacement; ///< of either model
    auto members() const {
        return std::tie(name, model, graph, openPbr, diffuseColor, emissiveColor, specularColor, metallic,
                        roughness, clearcoat, clearcoatRoughness, opacity, opacityThreshold, ior, normal,
                        occlusion, useSpecularWorkflow, opacityMode, displacement);
    }
    bool operator==(const MaterialDesc& o) const { return members() == o.members(); }
};

/// An input of OpenPBR Surface with the specification's default.
MaterialInput openPbrDefault(OpenPbrInput input);

/// The input of a description, or its default.
MaterialInput openPbrInput(const MaterialDesc& material, OpenPbrInput input);

} // namespace hipr
