// UsdPreviewSurface as data: a fixed row of inputs, each a constant or the index of an input node.
#ifndef HIPR_SHARED_MATERIAL_H
#define HIPR_SHARED_MATERIAL_H
#include "language.h"
HIPR_SHARED_BEGIN

HIPR_CONST uint INPUT_DIFFUSE_COLOR = 0u;
HIPR_CONST uint INPUT_EMISSIVE_COLOR = 1u;
HIPR_CONST uint INPUT_SPECULAR_COLOR = 2u;
HIPR_CONST uint INPUT_METALLIC = 3u;
HIPR_CONST uint INPUT_ROUGHNESS = 4u;
HIPR_CONST uint INPUT_CLEARCOAT = 5u;
HIPR_CONST uint INPUT_CLEARCOAT_ROUGHNESS = 6u;
HIPR_CONST uint INPUT_OPACITY = 7u;
HIPR_CONST uint INPUT_OPACITY_THRESHOLD = 8u;
HIPR_CONST uint INPUT_IOR = 9u;
HIPR_CONST uint INPUT_NORMAL = 10u;
HIPR_CONST uint INPUT_COUNT = 11u;

HIPR_CONST uint MATERIAL_SPECULAR_WORKFLOW = 1u;
HIPR_CONST uint MATERIAL_PRESENCE = 2u;     // (1 - opacity) of light goes straight through the surface, unrefracted
HIPR_CONST uint MATERIAL_REFRACTIVE = 4u;   // constant opacity < 1 in transparent mode: a glass interface with `ior`
HIPR_CONST uint MATERIAL_EMISSIVE = 8u;
HIPR_CONST uint MATERIAL_HAS_NODES = 16u;   // some input is not constant
HIPR_CONST uint MATERIAL_NON_OPAQUE = 32u;  // rays may pass straight through

// An input fed by a texture or a primvar.
struct InputNode {
    uint texture;            // first TextureRecord, NO_INDEX: primvar reader
    uint udimTiles;          // 0: an ordinary texture; else the number of TextureRecords, tile 1001 + i is texture + i
    uint primvar;            // interned name: the st primvar of a texture, or the primvar read
    uint channel;            // hipr::Channel
    vec4 scale;
    vec4 bias;
    vec4 fallback;           // missing texture or primvar
    vec2 uvAxisU;            // st' = uvAxisU * s + uvAxisV * t + uvOffset
    vec2 uvAxisV;
    vec2 uvOffset;
    vec2 uvFallback;
};

struct MaterialRecord {
    vec4 constants[INPUT_COUNT];
    uint nodes[INPUT_COUNT]; // index into the array at `inputNodes`, NO_INDEX: constant
    uint flags;              // MATERIAL_*
    uint64_t inputNodes;     // InputNode[]
};

HIPR_CONST uint TEXEL_RGBA8_SRGB = 0u;      // colour sRGB-encoded, alpha linear
HIPR_CONST uint TEXEL_RGBA8 = 1u;
HIPR_CONST uint TEXEL_RGBA16F = 2u;
HIPR_CONST uint TEXEL_RGBA32F = 3u;
HIPR_CONST uint TEXEL_NONE = 4u;            // unreadable texture or an absent UDIM tile: use the node's fallback

HIPR_CONST uint WRAP_BLACK = 0u;
HIPR_CONST uint WRAP_CLAMP = 1u;
HIPR_CONST uint WRAP_REPEAT = 2u;
HIPR_CONST uint WRAP_MIRROR = 3u;

// Texels in a buffer, bilinear-filtered in the shader: no descriptor, so thousands cost nothing. Row 0 is t = 0 (bottom).
struct TextureRecord {
    uint64_t texels;
    uint width;
    uint height;
    uint format;             // TEXEL_*
    uint wrapS;              // WRAP_*
    uint wrapT;
    uint pad;
};

// An index of refraction this near to 1 bends nothing: constant ones make the material MATERIAL_PRESENCE.
HIPR_CONST float MIN_IOR_STEP = 0.01f;

// Directional albedo of a GGX lobe: ALBEDO_ROUGHNESSES rows of ALBEDO_COSINES + 1 vec2 (see renderer/shading/albedo.h).
HIPR_CONST uint ALBEDO_COSINES = 32u;
HIPR_CONST uint ALBEDO_ROUGHNESSES = 24u;

HIPR_SHARED_END
#endif
