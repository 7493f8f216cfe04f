/// @file material.h
/// Materials as data: every input is a constant, a texture or a primvar.
#pragma once

#include <map>
#include <tuple>

#include "renderer/api/openpbr.h"
#include "renderer/api/types.h"

namespace hipr {

enum class WrapMode : uint32_t { Black, Clamp, Repeat, Mirror, UseMetadata };

/// Channel of a texture or primvar that feeds a scalar input; Rgb feeds colours and normals.
enum class Channel : uint32_t { R, G, B, A, Rgb };

/// A UsdUVTexture node with its st reader and UsdTransform2d nodes folded in.
struct TextureDesc {
    std::string path;                    ///< resolved path; may hold the text `<UDIM>`
    std::string colorSpace = "auto";     ///< auto, raw, sRGB, or the name of an OpenColorIO colour space
    WrapMode wrapS = WrapMode::UseMetadata, wrapT = WrapMode::UseMetadata;
    glm::vec4 scale{1.f}, bias{0.f}, fallback{0.f, 0.f, 0.f, 1.f};
    std::string uvPrimvar = "st";
    glm::vec2 uvFallback{0.f};           ///< used when the mesh lacks `uvPrimvar`
    glm::mat3x2 uvTransform{1.f, 0.f, 0.f, 1.f, 0.f, 0.f}; ///< columns: u axis, v axis, translation
    auto members() const {
        return std::tie(path, colorSpace, wrapS, wrapT, scale, bias, fallback, uvPrimvar, uvFallback, uvTransform);
    }
    bool operator==(const TextureDesc& o) const { return members() == o.members(); }
};

/// One input of a material.
struct MaterialInput {
    enum class Source : uint32_t { Constant, Texture, Primvar } source = Source::Constant;
    glm::vec4 constant{0.f};             ///< the value, or the fallback of a primvar reader
    Channel channel = Channel::Rgb;
    TextureDesc texture;
    std::string primvar;
    auto members() const { return std::tie(source, constant, channel, texture, primvar); }
    bool operator==(const MaterialInput& o) const { return members() == o.members(); }
};

enum class OpacityMode : uint32_t { Transparent, Presence };

enum class MaterialModel : uint32_t { UsdPreviewSurface, OpenPbr };

/// A material of either model; the inputs of the other one are ignored.
struct MaterialDesc {
    std::string name;
    MaterialModel model = MaterialModel::UsdPreviewSurface;

    /// The inputs of OpenPBR Surface; those absent have the specification's defaults (openPbrInputs()).
    std::map<OpenPbrInput, MaterialInput> openPbr;

    /// The inputs of UsdPreviewSurface with the specification's defaults (UsdPreviewSurface Specification
    /// 2.6, section "UsdPreviewSurface").
    MaterialInput diffuseColor{MaterialInput::Source::Constant, glm::vec4(0.18f, 0.18f, 0.18f, 1.f), Channel::Rgb, {}, {}};
    MaterialInput emissiveColor{};
    MaterialInput specularColor{};
    MaterialInput metallic{};
    MaterialInput roughness{MaterialInput::Source::Constant, glm::vec4(0.5f), Channel::R, {}, {}};
    MaterialInput clearcoat{};
    MaterialInput clearcoatRoughness{MaterialInput::Source::Constant, glm::vec4(0.01f), Channel::R, {}, {}};
    MaterialInput opacity{MaterialInput::Source::Constant, glm::vec4(1.f), Channel::R, {}, {}};
    MaterialInput opacityThreshold{};
    MaterialInput ior{MaterialInput::Source::Constant, glm::vec4(1.5f), Channel::R, {}, {}};
    MaterialInput normal{MaterialInput::Source::Constant, glm::vec4(0.f, 0.f, 1.f, 0.f), Channel::Rgb, {}, {}};
    MaterialInput occlusion{MaterialInput::Source::Constant, glm::vec4(1.f), Channel::R, {}, {}};
    bool useSpecularWorkflow = false;
    OpacityMode opacityMode = OpacityMode::Transparent;
    auto members() const {
        return std::tie(name, model, openPbr, diffuseColor, emissiveColor, specularColor, metallic, roughness, clearcoat,
                        clearcoatRoughness, opacity, opacityThreshold, ior, normal, occlusion, useSpecularWorkflow,
                        opacityMode);
    }
    bool operator==(const MaterialDesc& o) const { return members() == o.members(); }
};

/// An input of OpenPBR Surface with the specification's default.
MaterialInput openPbrDefault(OpenPbrInput input);

/// The input of a description, or its default.
MaterialInput openPbrInput(const MaterialDesc& material, OpenPbrInput input);

} // namespace hipr
