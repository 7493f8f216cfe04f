// Ray origins that do not hit their own surface again.
#ifndef HIPR_TRACE_OFFSET_GLSL
#define HIPR_TRACE_OFFSET_GLSL

// Moves a point off its surface to the side of `normal` by a number of units in the last place, which follows the
// magnitude of the rounding error, and by a fixed distance near zero. C. Waechter and N. Binder, "A Fast and Robust
// Method for Avoiding Self-Intersection", Ray Tracing Gems, chapter 6.
vec3 offsetOrigin(vec3 point, vec3 normal) {
    const float nearZero = 1.0 / 32.0;
    const float fixedStep = 1.0 / 65536.0;
    const ivec3 ulps = ivec3(256.0 * normal);
    const ivec3 bits = floatBitsToInt(point);
    const vec3 stepped = intBitsToFloat(bits + mix(ulps, -ulps, lessThan(point, vec3(0.0))));
    return mix(stepped, point + fixedStep * normal, lessThan(abs(point), vec3(nearZero)));
}
#endif
