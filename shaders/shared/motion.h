// Where moving things are at a time of the shutter, 0 when it opens and 1 when it closes: keys at equal distances, straight
// ways between them. Compiled as GLSL and as C++ with the same operations in the same order, as intersect.h is.
#ifndef HIPR_SHARED_MOTION_H
#define HIPR_SHARED_MOTION_H
#include "language.h"
HIPR_SHARED_BEGIN
#ifdef __cplusplus
using glm::max;
using glm::min;
#endif

// A time between key `first` and the next one.
struct KeyTime {
    uint first;
    float weight; // of the next one
};

// `time` in [0, 1]; `keys` at least 2.
HIPR_INLINE KeyTime keyTime(float time, uint keys) {
    HIPR_PRECISE float at = time * float(keys - 1u);
    KeyTime k;
    k.first = min(uint(at), keys - 2u);
    HIPR_PRECISE float weight = at - float(k.first);
    k.weight = weight;
    return k;
}

// Never leaves the box of `a` and `b`, so that a box around all keys holds what is between them.
HIPR_INLINE vec3 mixKeys(vec3 a, vec3 b, float weight) {
    HIPR_PRECISE vec3 mixed = a + (b - a) * weight;
    return max(min(mixed, max(a, b)), min(a, b));
}

HIPR_INLINE mat4x3 mixTransforms(mat4x3 a, mat4x3 b, float weight) {
    return mat4x3(mixKeys(a[0], b[0], weight), mixKeys(a[1], b[1], weight), mixKeys(a[2], b[2], weight),
                  mixKeys(a[3], b[3], weight));
}

HIPR_INLINE vec3 crossRounded(vec3 a, vec3 b) {
    HIPR_PRECISE vec3 r;
    r.x = a.y * b.z - b.y * a.z;
    r.y = a.z * b.x - b.z * a.x;
    r.z = a.x * b.y - b.x * a.y;
    return r;
}

// Of an affine map that is not singular.
HIPR_INLINE mat4x3 inverseTransform(mat4x3 m) {
    vec3 x = crossRounded(m[1], m[2]), y = crossRounded(m[2], m[0]), z = crossRounded(m[0], m[1]);
    HIPR_PRECISE float determinant = (m[0].x * x.x + m[0].y * x.y) + m[0].z * x.z;
    HIPR_PRECISE float scale = 1.0f / determinant;
    HIPR_PRECISE vec3 sx = x * scale;
    HIPR_PRECISE vec3 sy = y * scale;
    HIPR_PRECISE vec3 sz = z * scale;
    HIPR_PRECISE vec3 offset;
    offset.x = -((sx.x * m[3].x + sx.y * m[3].y) + sx.z * m[3].z);
    offset.y = -((sy.x * m[3].x + sy.y * m[3].y) + sy.z * m[3].z);
    offset.z = -((sz.x * m[3].x + sz.y * m[3].y) + sz.z * m[3].z);
    return mat4x3(vec3(sx.x, sy.x, sz.x), vec3(sx.y, sy.y, sz.y), vec3(sx.z, sy.z, sz.z), offset);
}

HIPR_SHARED_END
#endif
