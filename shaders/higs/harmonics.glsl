// Colours of splats: real spherical harmonics up to degree 3 (Kerbl et al. 2023; signs as there).
#ifndef HIPR_HIGS_HARMONICS_GLSL
#define HIPR_HIGS_HARMONICS_GLSL
#include "higs/frame.glsl"

// Two neighbouring coefficients, the first of even index: six halves in three words.
vec3 addPair(WordRef words, uint at, float first, float second) {
    const vec2 a = unpackHalf2x16(words.v[at]), b = unpackHalf2x16(words.v[at + 1u]), c = unpackHalf2x16(words.v[at + 2u]);
    return first * vec3(a, b.x) + second * vec3(b.y, c);
}

// `d`: from the camera to the splat, object space, of unit length.
vec3 splatColor(SplatArrays arrays, uint i, vec3 d) {
    if (arrays.coefficients == 0ul) return vec3(0.5);
    WordRef words = WordRef(arrays.coefficients);
    const uint count = (arrays.degree + 1u) * (arrays.degree + 1u);
    const uint at = i * ((count + 1u) / 2u) * 3u;
    const bool linear = arrays.degree >= 1u;
    vec3 color = 0.5 + addPair(words, at, 0.28209479177387814, linear ? -0.4886025119029199 * d.y : 0.0);
    const float xx = d.x * d.x, yy = d.y * d.y, zz = d.z * d.z;
    if (linear) color += addPair(words, at + 3u, 0.4886025119029199 * d.z, -0.4886025119029199 * d.x);
    if (arrays.degree >= 2u) {
        const bool cubic = arrays.degree >= 3u;
        color += addPair(words, at + 6u, 1.0925484305920792 * d.x * d.y, -1.0925484305920792 * d.y * d.z);
        color += addPair(words, at + 9u, 0.31539156525252005 * (2.0 * zz - xx - yy), -1.0925484305920792 * d.x * d.z);
        color += addPair(words, at + 12u, 0.5462742152960396 * (xx - yy),
                         cubic ? -0.5900435899266435 * d.y * (3.0 * xx - yy) : 0.0);
        if (cubic) {
            color += addPair(words, at + 15u, 2.890611442640554 * d.x * d.y * d.z,
                             -0.4570457994644658 * d.y * (4.0 * zz - xx - yy));
            color += addPair(words, at + 18u, 0.3731763325901154 * d.z * (2.0 * zz - 3.0 * xx - 3.0 * yy),
                             -0.4570457994644658 * d.x * (4.0 * zz - xx - yy));
            color += addPair(words, at + 21u, 1.445305721320277 * d.z * (xx - yy),
                             -0.5900435899266435 * d.x * (xx - 3.0 * yy));
        }
    }
    return max(color, vec3(0.0));
}
#endif
