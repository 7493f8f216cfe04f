/// @file material_input.h
/// What feeds one input of a material.
#pragma once

#include <tuple>

#include "renderer/api/types.h"

namespace hipr {

enum class WrapMode : uint32_t { Black, Clamp, Repeat, Mirror, UseMetadata };

/// Channel of a texture or primvar that feeds a scalar input; Rgb feeds colours and normals.
enum class Channel : uint32_t { R, G, B, A, Rgb };

/// A UsdUVTexture node with its st reader and UsdTransform2d nodes folded in.
struct TextureDesc {
    std::string path;                ///< resolved path; may hold the text `<UDIM>`
    std::string colorSpace = "auto"; ///< auto, raw, sRGB, or the name of an OpenColorIO colour space
    WrapMode wrapS = WrapMode::UseMetadata, wrapT = WrapMode::UseMetadata;
    glm::vec4 scale{1.f}, bias{0.f}, fallback{0.f, 0.f, 0.f, 1.f};
    std::string uvPrimvar = "st";
    glm::vec2 uvFallback{0.f};                             ///< used when the mesh lacks `uvPrimvar`
    glm::mat3x2 uvTransform{1.f, 0.f, 0.f, 1.f, 0.f, 0.f}; ///< columns: u axis, v axis, translation
    auto members() const {
        return std::tie(path, colorSpace, wrapS, wrapT, scale, bias, fallback, uvPrimvar, uvFallback,
                        uvTransform);
    }
    bool operator==(const TextureDesc& o) const { return members() == o.members(); }
};

/// One input of a material.
struct MaterialInput {
    enum class Source : uint32_t { Constant, Texture, Primvar, Graph } source = Source::Constant;
    glm::vec4 constant{0.f}; ///< the value, or the fallback of a primvar reader
    Channel channel = Channel::Rgb;
    TextureDesc texture;
    std::string primvar;
    uint32_t node = 0; ///< of MaterialDesc::graph
    auto members() const { return std::tie(source, constant, channel, texture, primvar, node); }
    bool operator==(const MaterialInput& o) const { return members() == o.members(); }
};

} // namespace hipr
