/// @file film.h
/// Arbitrary output variables (AOVs): what can be asked for and what comes back.
#pragma once

#include "renderer/api/types.h"

namespace hipr {

/// Colours are scene-linear and unclamped. Ids are -1 where no surface is seen. "First hit" AOVs come from one ray
/// through the pixel centre; color and albedo are means over all samples of the pixel. SampleCount, Priority, Age and
/// Discovered tell of HiPR's tiles.
enum class AovKind : uint32_t {
    Color,       ///< float4, premultiplied alpha
    Albedo,      ///< float3
    Depth,       ///< float, projected depth 0..1, 1 where nothing is seen
    CameraDepth, ///< float, distance along the view axis in scene units, 0 where nothing is seen
    Normal,      ///< float3, world-space shading normal, 0 where nothing is seen
    Neye,        ///< float3, view-space shading normal
    PrimId,      ///< int
    InstanceId,  ///< int
    ElementId,   ///< int, authored face index
    Primvar,     ///< float3, a named primvar at the first hit (missing components are 0)
    SampleCount, ///< int, samples of the current scene in the mean of this pixel; 0: it shows an older picture
    Priority,    ///< float, by which tiles are ordered: mode delta, the change of radiance; mode paper, see docs/hipr.md
    Age,         ///< int, edits since the pixel's picture was rendered; 0: it is current
    Discovered,  ///< int, 1 where the last edit was found to show, and 0
    Peye,        ///< float3, view-space position, 0 where nothing is seen
    PatchCoord,  ///< float3, barycentric coordinates (u, v, 0) in the triangle that is seen
    Variance,    ///< float3, that of color's channels as an estimate: sample variance / samples; 0 below 2 samples
    CryptoObject,   ///< float4, two ranks of (id, coverage) of the objects that samples see: AovRequest::layer
    CryptoMaterial, ///< the same of the materials they show
    CryptoAsset,    ///< the same of ObjectDesc::asset
    Lpe,            ///< float3, the part of color that came along paths which AovRequest::name describes
    Motion,         ///< float2, pixels by which what is seen moves while the shutter is open
};

/// Layers of two ranks that a Cryptomatte AOV has: see renderer/api/cryptomatte.h.
constexpr uint32_t CryptomatteLayers = 3;

struct AovRequest {
    AovKind kind = AovKind::Color;
    std::string name;   ///< for AovKind::Primvar, of the primvar; for AovKind::Lpe, the light path expression
    uint32_t layer = 0; ///< for Cryptomatte, 0 to CryptomatteLayers - 1
    bool operator==(const AovRequest& o) const {
        return kind == o.kind && name == o.name && layer == o.layer;
    }
};

/// 4-byte words per pixel of an AOV, and whether they are ints.
struct AovFormat {
    uint32_t components;
    bool integer;
};
AovFormat aovFormat(AovKind kind);

/// The picture to make. Changing it discards all samples.
struct FilmDesc {
    uint32_t width = 0, height = 0;
    std::vector<AovRequest> aovs{{AovKind::Color, {}}};
    bool operator==(const FilmDesc& o) const { return width == o.width && height == o.height && aovs == o.aovs; }
};

} // namespace hipr
