/// @file openpbr.h
/// The inputs of OpenPBR Surface 1.1 (Academy Software Foundation,
/// https://academysoftwarefoundation.github.io/OpenPBR/).
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

namespace hipr {

enum class OpenPbrInput : uint32_t {
    BaseWeight,
    BaseColor,
    BaseDiffuseRoughness,
    BaseMetalness,
    SpecularWeight,
    SpecularColor,
    SpecularRoughness,
    SpecularIor,
    SpecularRoughnessAnisotropy,
    TransmissionWeight,
    TransmissionColor,
    TransmissionDepth,
    TransmissionScatter,
    TransmissionScatterAnisotropy,
    TransmissionDispersionScale,
    TransmissionDispersionAbbeNumber,
    SubsurfaceWeight,
    SubsurfaceColor,
    SubsurfaceRadius,
    SubsurfaceRadiusScale,
    SubsurfaceScatterAnisotropy,
    FuzzWeight,
    FuzzColor,
    FuzzRoughness,
    CoatWeight,
    CoatColor,
    CoatRoughness,
    CoatRoughnessAnisotropy,
    CoatIor,
    CoatDarkening,
    ThinFilmWeight,
    ThinFilmThickness,
    ThinFilmIor,
    EmissionLuminance,
    EmissionColor,
    GeometryOpacity,
    GeometryThinWalled,
    GeometryNormal,
    GeometryCoatNormal,
    GeometryTangent,
    GeometryCoatTangent,
    /// No input of OpenPBR 1.1, but of other renderers' surfaces by this name: where transmitting objects
    /// overlap, the inside of the one of the highest priority is there. All 0: overlaps are not resolved.
    DielectricPriority,
    Count
};

/// How far an input takes effect.
enum class InputUse : uint32_t {
    Full,     ///< constants, textures and primvars
    Constant, ///< the constant alone: what drives the input otherwise has no effect
    Texture,  ///< normal maps: a texture or a graph alone
    Graph     ///< a direction in world space that a graph makes
};

/// One row of the table that parser, renderer, dump and documentation share.
struct OpenPbrInputInfo {
    const char* name;    ///< as in the specification
    uint32_t components; ///< 1 or 3
    glm::vec4 value;     ///< the specification's default
    float least, most;   ///< range of the components
    InputUse use;
};

/// By OpenPbrInput.
const std::array<OpenPbrInputInfo, size_t(OpenPbrInput::Count)>& openPbrInputs();

} // namespace hipr
