// Keys of moving instances in device memory.
#ifndef HIPR_ACCEL_MOTION_GLSL
#define HIPR_ACCEL_MOTION_GLSL
#include "shared/references.glsl"
#include "shared/motion.h"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TransformRef { mat4x3 v[]; };

// Object to world at a time of the shutter; `count` keys from `first` on.
mat4x3 transformAt(uint64_t keys, uint first, uint count, float time) {
    const KeyTime at = keyTime(time, count);
    TransformRef transforms = TransformRef(keys);
    return mixTransforms(transforms.v[first + at.first], transforms.v[first + at.first + 1u], at.weight);
}
#endif
