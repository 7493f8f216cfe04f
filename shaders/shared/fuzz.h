// The fuzz of OpenPBR: a layer of fibres along the normal, of optical thickness 1, seen by light that is scattered once.
// Light scattered more often is taken to go on to what is below. The flakes are those of E. Heitz et al., "The SGGX
// Microflake Distribution", ACM TOG 34(4), 2015, with S = diag(1, 1, roughness^2).
#ifndef HIPR_SHARED_FUZZ_H
#define HIPR_SHARED_FUZZ_H
#include "language.h"
#ifdef __cplusplus
#include <cmath>
namespace hipr::gpu {
using std::exp;
using std::sqrt;
}
#endif
HIPR_SHARED_BEGIN

// Projected area of the flakes towards a direction of cosine `z`.
HIPR_INLINE float flakeArea(float z, float roughness) {
    return sqrt(1.0f - (1.0f - roughness * roughness) * z * z);
}

// BRDF times the cosine of `i`, of a white layer: the phase function of mirror-like flakes, attenuated along the ways of
// `o` and `i` through the layer and integrated over its depth. Reciprocal. Both directions lie above the surface.
HIPR_INLINE float fuzzReflection(vec3 o, vec3 i, float roughness) {
    vec3 h = o + i;
    float squared = h.x * h.x + h.y * h.y + h.z * h.z;
    float z2 = squared > 0.0f ? h.z * h.z / squared : 1.0f, r2 = roughness * roughness;
    float t = r2 * (1.0f - z2) + z2;
    float density = r2 * roughness / (3.14159265f * t * t);
    float depth = flakeArea(o.z, roughness) / o.z + flakeArea(i.z, roughness) / i.z;
    return 0.25f * density * (1.0f - exp(-depth)) / (depth * o.z);
}

HIPR_SHARED_END
#endif
