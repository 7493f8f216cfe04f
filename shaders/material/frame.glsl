// Directions and frames.
#ifndef HIPR_MATERIAL_FRAME_GLSL
#define HIPR_MATERIAL_FRAME_GLSL

const float PI = 3.14159265358979;

// An orthonormal frame: columns tangent, bitangent, n. T. Duff et al., "Building an Orthonormal Basis, Revisited",
// JCGT 6(1), 2017.
mat3 frameAround(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

// `v` scaled to unit length, or `otherwise` when it has no direction (zero, infinite or NaN).
vec3 normalizeOr(vec3 v, vec3 otherwise) {
    float squared = dot(v, v);
    return squared > 1e-30 && squared < 1e30 ? v * inversesqrt(squared) : otherwise;
}

float luminance(vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }
#endif
