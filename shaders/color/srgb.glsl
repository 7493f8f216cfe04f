// The sRGB transfer curve.
#ifndef HIPR_COLOR_SRGB_GLSL
#define HIPR_COLOR_SRGB_GLSL

// IEC 61966-2-1.
vec3 decodeSrgb(vec3 c) {
    return mix(pow((c + 0.055) * (1.0 / 1.055), vec3(2.4)), c * (1.0 / 12.92), lessThanEqual(c, vec3(0.04045)));
}
#endif
