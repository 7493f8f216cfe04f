// The GGX microfacet distribution in a frame whose z axis is the surface normal, and Fresnel terms.
// B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007;
// E. Heitz, "Understanding the Masking-Shadowing Function", JCGT 3(2), 2014.
#ifndef HIPR_MATERIAL_MICROFACET_GLSL
#define HIPR_MATERIAL_MICROFACET_GLSL
#include "material/frame.glsl"
#include "shared/references.glsl"

// The smallest slope parameter alpha: nearer to a mirror than a pixel shows (0.01 degrees), and still far from the limits
// of single precision. Mirrors and clear glass are such lobes; no lobe is a delta distribution.
const float MIN_ALPHA = 2e-4;

// Slope parameters along tangent and bitangent: OpenPBR Surface specification, "Microfacet model".
vec2 stretchedAlpha(float roughness, float anisotropy) {
    float across = 1.0 - clamp(anisotropy, 0.0, 1.0);
    float along = roughness * roughness * sqrt(2.0 / (1.0 + across * across));
    return max(vec2(along, across * along), MIN_ALPHA);
}

// Density of microfacet normals (Walter eq. 33, stretched along x and y), written in sines so that no small difference is
// taken.
float ggxDensity(vec3 h, vec2 alpha) {
    vec2 slope = h.xy / alpha;
    float t = dot(slope, slope) + h.z * h.z;
    return 1.0 / (PI * alpha.x * alpha.y * t * t);
}

// Smith's Lambda (Heitz 2014, eqs. 72 and 86): masking is 1 / (1 + Lambda).
float ggxLambda(vec3 w, vec2 alpha) {
    vec2 slope = alpha * w.xy;
    return 0.5 * sqrt(1.0 + dot(slope, slope) / (w.z * w.z)) - 0.5;
}

// A normal visible from `w` (w.z > 0): density ggxDensity(h) * max(0, dot(w, h)) / ((1 + Lambda(w)) * w.z).
// J. Dupuy and A. Benyoub, "Sampling Visible GGX Normals with Spherical Caps", HPG 2023 (same distribution as
// E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018).
vec3 sampleVisibleNormal(vec3 w, vec2 alpha, vec2 u) {
    vec3 stretched = normalize(vec3(alpha * w.xy, w.z));
    float phi = 2.0 * PI * u.x;
    float z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    float r = sqrt(clamp(1.0 - z * z, 0.0, 1.0));
    vec3 h = vec3(r * cos(phi), r * sin(phi), z) + stretched;
    return normalize(vec3(alpha * h.xy, max(h.z, 1e-7)));
}

// The part of what a facet `h` reflects that no other facet stops on its way up; `lambdaO` is ggxLambda(o).
float reflectedPart(vec3 o, vec3 h, vec2 alpha, float lambdaO) {
    vec3 i = 2.0 * dot(o, h) * h - o;
    return i.z > 0.0 ? (1.0 + lambdaO) / (1.0 + lambdaO + ggxLambda(i, alpha)) : 0.0;
}

// Where a facet refracts light from `o` to, whose cosine to it is `cosine`. Snell's law: Walter eq. 40.
vec3 refractedBy(vec3 h, vec3 o, float cosine, float eta) {
    float inverse = 1.0 / eta;
    float cosT = sqrt(max(0.0, 1.0 - inverse * inverse * (1.0 - cosine * cosine)));
    return normalize((inverse * cosine - cosT) * h - inverse * o);
}

// As reflectedPart(), of what a facet refracts, on its way down.
float refractedPart(vec3 o, vec3 h, vec2 alpha, float eta) {
    vec3 i = refractedBy(h, o, dot(o, h), eta);
    return i.z < 0.0 ? 1.0 / (1.0 + ggxLambda(i, alpha)) : 0.0;
}

// (1 - cosine)^5 of Schlick's approximation (C. Schlick, "An Inexpensive BRDF Model", 1994).
float schlickWeight(float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    return m * m * m * m * m;
}

// Unpolarised reflectance of an interface (Walter eq. 22); `eta` is the index beyond it over the index before it.
float dielectricFresnel(float cosine, float eta) {
    float g2 = eta * eta - 1.0 + cosine * cosine;
    if (g2 <= 0.0) return 1.0; // total internal reflection
    float g = sqrt(g2);
    float a = (g - cosine) / (g + cosine);
    float b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Directional albedo of the reflecting GGX lobe with Schlick Fresnel: f0 * result.x + result.y (f90 = 1), from the table
// that renderer/shading/albedo.h describes. Interpolated in sqrt(cosine) and roughness.
vec2 specularAlbedo(uint64_t table, float cosine, float roughness) {
    Vec2Ref entries = Vec2Ref(table);
    float x = sqrt(clamp(cosine, 0.0, 1.0)) * float(ALBEDO_COSINES - 1u);
    float y = clamp(roughness, 0.0, 1.0) * float(ALBEDO_ROUGHNESSES - 1u);
    uint i = min(uint(x), ALBEDO_COSINES - 2u);
    uint j = min(uint(y), ALBEDO_ROUGHNESSES - 2u);
    uint at = j * (ALBEDO_COSINES + 1u) + i;
    vec2 low = mix(entries.v[at], entries.v[at + 1u], x - float(i));
    at += ALBEDO_COSINES + 1u;
    vec2 high = mix(entries.v[at], entries.v[at + 1u], x - float(i));
    return mix(low, high, y - float(j));
}

// The same, averaged over the hemisphere with cosine weight.
vec2 meanSpecularAlbedo(uint64_t table, float roughness) {
    Vec2Ref entries = Vec2Ref(table);
    float y = clamp(roughness, 0.0, 1.0) * float(ALBEDO_ROUGHNESSES - 1u);
    uint j = min(uint(y), ALBEDO_ROUGHNESSES - 2u);
    uint at = j * (ALBEDO_COSINES + 1u) + ALBEDO_COSINES;
    return mix(entries.v[at], entries.v[at + ALBEDO_COSINES + 1u], y - float(j));
}
#endif
