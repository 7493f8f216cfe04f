// What occluders leave of a light whose shadows are not plain (UsdLuxShadowAPI).
#ifndef HIPR_LIGHT_SHADOW_GLSL
#define HIPR_LIGHT_SHADOW_GLSL
#include "shared/references.glsl"

// The share of light that gets through an occluder at `distance` from the lit point.
vec3 throughOccluder(ShadowRecord shadow, float distance) {
    if (distance >= shadow.end) return vec3(1.0);
    if (distance <= shadow.fadeStart) return shadow.color;
    float strength = pow((shadow.end - distance) / (shadow.end - shadow.fadeStart), shadow.gamma);
    return mix(vec3(1.0), shadow.color, strength);
}
#endif
