// Materials as data: a row of inputs, each a constant that a program may replace.
#ifndef HIPR_SHARED_MATERIAL_H
#define HIPR_SHARED_MATERIAL_H
#include "language.h"
HIPR_SHARED_BEGIN

// Inputs of both models, by OpenPBR's names. Those of a UsdPreviewSurface come first, so that its row is the beginning
// of an OpenPBR row.
HIPR_CONST uint INPUT_BASE_COLOR = 0u;              // diffuseColor
HIPR_CONST uint INPUT_EMISSION_COLOR = 1u;          // emissiveColor
HIPR_CONST uint INPUT_SPECULAR_COLOR = 2u;          // specularColor
HIPR_CONST uint INPUT_BASE_METALNESS = 3u;          // metallic
HIPR_CONST uint INPUT_SPECULAR_ROUGHNESS = 4u;      // roughness
HIPR_CONST uint INPUT_COAT_WEIGHT = 5u;             // clearcoat
HIPR_CONST uint INPUT_COAT_ROUGHNESS = 6u;          // clearcoatRoughness
HIPR_CONST uint INPUT_OPACITY = 7u;                 // opacity
HIPR_CONST uint INPUT_OPACITY_THRESHOLD = 8u;       // opacityThreshold; OpenPBR has none: 0
HIPR_CONST uint INPUT_SPECULAR_IOR = 9u;            // ior
HIPR_CONST uint INPUT_NORMAL = 10u;                 // normal
HIPR_CONST uint PREVIEW_INPUT_COUNT = 11u;
HIPR_CONST uint INPUT_BASE_WEIGHT = 11u;
HIPR_CONST uint INPUT_BASE_DIFFUSE_ROUGHNESS = 12u;
HIPR_CONST uint INPUT_SPECULAR_WEIGHT = 13u;
HIPR_CONST uint INPUT_SPECULAR_ANISOTROPY = 14u;
HIPR_CONST uint INPUT_TRANSMISSION_WEIGHT = 15u;
HIPR_CONST uint INPUT_TRANSMISSION_COLOR = 16u;
HIPR_CONST uint INPUT_SUBSURFACE_WEIGHT = 17u;
HIPR_CONST uint INPUT_SUBSURFACE_COLOR = 18u;
HIPR_CONST uint INPUT_SUBSURFACE_ANISOTROPY = 19u;
HIPR_CONST uint INPUT_FUZZ_WEIGHT = 20u;
HIPR_CONST uint INPUT_FUZZ_COLOR = 21u;
HIPR_CONST uint INPUT_FUZZ_ROUGHNESS = 22u;
HIPR_CONST uint INPUT_COAT_COLOR = 23u;
HIPR_CONST uint INPUT_COAT_ANISOTROPY = 24u;
HIPR_CONST uint INPUT_COAT_IOR = 25u;
HIPR_CONST uint INPUT_COAT_DARKENING = 26u;
HIPR_CONST uint INPUT_EMISSION_LUMINANCE = 27u;
HIPR_CONST uint INPUT_THIN_FILM_WEIGHT = 28u;
HIPR_CONST uint INPUT_THIN_FILM_THICKNESS = 29u;
HIPR_CONST uint INPUT_THIN_FILM_IOR = 30u;
HIPR_CONST uint INPUT_TANGENT = 31u;                // no value: its node names the st that anisotropy follows
HIPR_CONST uint INPUT_SUBSURFACE_RADIUS = 32u;
HIPR_CONST uint INPUT_SUBSURFACE_RADIUS_SCALE = 33u;
HIPR_CONST uint INPUT_COUNT = 34u;
// Beside the row: set by programs alone.
HIPR_CONST uint INPUT_WORLD_NORMAL = 34u;           // in the place of INPUT_NORMAL, in world space, on the front side
HIPR_CONST uint INPUT_COAT_NORMAL = 35u;            // further directions in world space, on the front side
HIPR_CONST uint INPUT_SPECULAR_TANGENT = 36u;
HIPR_CONST uint INPUT_COAT_TANGENT = 37u;

HIPR_CONST uint MATERIAL_SPECULAR_WORKFLOW = 1u;
HIPR_CONST uint MATERIAL_PRESENCE = 2u;     // (1 - opacity) of light goes straight through the surface, unrefracted
HIPR_CONST uint MATERIAL_REFRACTIVE = 4u;   // UsdPreviewSurface: constant opacity < 1 in transparent mode, a glass
                                            // interface with `ior`; OpenPBR: light may be refracted into the object
HIPR_CONST uint MATERIAL_EMISSIVE = 8u;
HIPR_CONST uint MATERIAL_NON_OPAQUE = 16u;  // rays may pass straight through
HIPR_CONST uint MATERIAL_OPENPBR = 32u;     // the model: OpenPBR Surface; else UsdPreviewSurface
HIPR_CONST uint MATERIAL_THIN_WALLED = 64u;
HIPR_CONST uint MATERIAL_SUBSURFACE = 128u; // subsurface light travels through a medium; else it leaves where it came

// PathState::medium: what the path travels through, MEDIUM_* in the lowest bits, then the material's record.
HIPR_CONST uint MEDIUM_NONE = 0u;
HIPR_CONST uint MEDIUM_INTERIOR = 1u;
HIPR_CONST uint MEDIUM_SUBSURFACE = 2u;
HIPR_CONST uint MEDIUM_KIND = 3u;
HIPR_CONST uint MEDIUM_SHIFT = 2u;
HIPR_CONST uint MEDIUM_DISPERSED = 0x80000000u; // the path has the wavelength of its pixel's sample

// What a program reads: a texture or a primvar.
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

// What light travels through: absorbs and scatters it with Henyey and Greenstein's phase function.
struct MediumRecord {
    vec3 extinction;         // per unit of length in world space; 0: a vacuum
    float anisotropy;        // mean cosine of scattering, -0.99..0.99
    vec3 albedo;             // the part of extinction that scatters
    float dispersion;        // Abbe number of the index of refraction, 0: the same for all wavelengths
};

struct MaterialRecord {
    MediumRecord interior;   // OpenPBR: inside the object, entered by refraction
    MediumRecord subsurface; // OpenPBR: inside the object, entered by diffuse transmission; albedo comes with the path,
                             // extinction too where it is 0 here
    uint64_t constants;      // vec4[PREVIEW_INPUT_COUNT or INPUT_COUNT], then those of the program
    uint64_t nodes;          // InputNode[]
    uint64_t steps;          // GraphStep[stepCount]: the program that sets inputs (shaders/shared/graph.h)
    uint stepCount;
    uint presenceSteps;      // the first of them, which opacity needs
    uint flags;              // MATERIAL_*
    int priority;            // of its inside where objects overlap: see shaders/material/nesting.glsl
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
HIPR_CONST uint WRAP_CUT = 4u;              // of coarser levels of WRAP_BLACK: black from the edge on, not from half a texel inside

// Texels in a buffer, bilinear-filtered in the shader: no descriptor, so thousands cost nothing. Row 0 is t = 0 (bottom).
// One level of detail of a texture; the finest is the one that materials and lights name.
struct TextureRecord {
    uint64_t texels;
    uint width;
    uint height;
    uint format;             // TEXEL_*
    uint wrapS;              // WRAP_*
    uint wrapT;
    uint coarserLevels;      // how many coarser levels there are, each half as large as the one before
    uint firstCoarser;       // TextureRecord of the first of them; the others follow
    uint pad;
};

// An index of refraction this near to 1 bends nothing: constant ones make the material MATERIAL_PRESENCE.
HIPR_CONST float MIN_IOR_STEP = 0.01f;

// Directional albedo of a GGX lobe: ALBEDO_ROUGHNESSES rows of ALBEDO_COSINES + 1 vec2 (see renderer/shading/albedo.h).
HIPR_CONST uint ALBEDO_COSINES = 32u;
HIPR_CONST uint ALBEDO_ROUGHNESSES = 24u;

// The tables of OpenPBR, one after the other in one buffer (see renderer/shading/openpbr_albedo.h).
// A rough dielectric interface seen from outside, then from inside: for each INTERFACE_STEPS * INTERFACE_ROUGHNESSES rows
// of INTERFACE_COSINES + 1 vec2.
HIPR_CONST uint INTERFACE_COSINES = 24u;
HIPR_CONST uint INTERFACE_ROUGHNESSES = 16u;
HIPR_CONST uint INTERFACE_STEPS = 16u;
HIPR_CONST float INTERFACE_MOST = 0.9f; // largest |(1 - eta) / (1 + eta)|
// Then the fuzz: FUZZ_ROUGHNESSES rows of FUZZ_COSINES floats.
HIPR_CONST uint FUZZ_COSINES = 32u;
HIPR_CONST uint FUZZ_ROUGHNESSES = 12u;
HIPR_CONST float FUZZ_LEAST_ROUGHNESS = 0.1f;

// Albedos of stretched lobes (see renderer/shading/stretched_albedo.h): STRETCHED_PLANES planes, of interfaces seen from
// outside, of those from inside, and of a perfect mirror. In a plane STRETCHED_ANISOTROPIES * STRETCHED_ROUGHNESSES rows of
// STRETCHED_AZIMUTHS * STRETCHED_COSINES + 1 vec2.
HIPR_CONST uint STRETCHED_COSINES = 20u;
HIPR_CONST uint STRETCHED_AZIMUTHS = 13u;
HIPR_CONST uint STRETCHED_ROUGHNESSES = 14u;
HIPR_CONST uint STRETCHED_ANISOTROPIES = 8u;
HIPR_CONST uint STRETCHED_STEPS = 24u;
HIPR_CONST uint STRETCHED_PLANES = 49u; // 2 * STRETCHED_STEPS + 1
HIPR_CONST uint STRETCHED_ROW = 261u;   // STRETCHED_AZIMUTHS * STRETCHED_COSINES + 1
HIPR_CONST uint STRETCHED_ROWS = 5488u; // STRETCHED_PLANES * STRETCHED_ANISOTROPIES * STRETCHED_ROUGHNESSES

HIPR_SHARED_END
#endif
