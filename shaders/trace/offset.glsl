// Ray origins that do not hit their own surface again.
#ifndef HIPR_TRACE_OFFSET_GLSL
#define HIPR_TRACE_OFFSET_GLSL

// Below this height over a triangle a ray from it may meet it again: the rounding of the triangle test (shared/intersect.h)
// goes with how far the vertices are, not with where the ray begins. e1 and e2 are two of its edges. Of random triangles
// and rays the highest was 2^-22 of the longest edge where a triangle is as wide as it is long, and less than n times that
// where it is n times as long as wide (4, 32, 256 times for 10, 100, 1000); this is twice n times that, as origins are
// rounded, too. Slivers of less than 1/16 get what those of 1/16 need, since more would lead past their edges.
float restlessHeight(vec3 e1, vec3 e2) {
    const vec3 e3 = e2 - e1;
    const float squared = max(max(dot(e1, e1), dot(e2, e2)), dot(e3, e3));
    const float slenderness = squared * inversesqrt(max(dot(cross(e1, e2), cross(e1, e2)), 1e-38));
    return 4.7683716e-7 * sqrt(squared) * clamp(slenderness, 1.0, 16.0);
}

// Moves a point off its surface to the side of `normal`, by `least` and by a number of units in the last place, which
// follows the magnitude of the rounding error of its position, and by a fixed distance near zero. C. Waechter and N. Binder,
// "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, chapter 6.
vec3 offsetOrigin(vec3 point, vec3 normal, float least) {
    const float nearZero = 1.0 / 32.0;
    const float fixedStep = 1.0 / 65536.0;
    const ivec3 ulps = ivec3(256.0 * normal);
    const ivec3 bits = floatBitsToInt(point);
    const vec3 stepped = intBitsToFloat(bits + mix(ulps, -ulps, lessThan(point, vec3(0.0))));
    const vec3 offset = mix(stepped, point + fixedStep * normal, lessThan(abs(point), vec3(nearZero)));
    return mix(offset, point + least * normal, lessThan(abs(offset - point), abs(least * normal)));
}
#endif
