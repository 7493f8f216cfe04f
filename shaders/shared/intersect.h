// The one definition of "this ray hits this triangle", compiled as GLSL and as C++ with the same operations in the same
// order (`precise` there, -ffp-contract=off here), so every traversal reports the same distance to the last bit.
//
// Triangle test: Woop, Benthin, Wald, "Watertight Ray/Triangle Intersection", JCGT 2(1), 2013, section 3, with inclusive
// edges in place of their double-precision fallback: rounding a product is monotonic, so the computed sign of an edge
// function is right or zero, and two triangles sharing an edge see the same value with opposite sign.
//
// Boxes are tested with an allowance (`boxRay`) that covers the rounding of the triangle test. In addition a hit counts
// only if the ray also meets the triangle's own box and the instance's box, and its distance is clamped to that
// interval. The box test is monotonic in the box, so every box around them passes as well: no tree, however built, can
// cull a hit that another tree finds.
#ifndef HIPR_SHARED_INTERSECT_H
#define HIPR_SHARED_INTERSECT_H
#include "scene.h"
#ifdef __cplusplus
#include <cmath>
#endif
HIPR_SHARED_BEGIN
#ifdef __cplusplus
using std::abs;
using glm::max;
using glm::min;
#endif

HIPR_CONST float BOX_ALLOWANCE = 9.5367431640625e-7f; // 2^-20: 16 rounding errors of the largest coordinate involved
HIPR_CONST float AXIS_RATIO = 1e-9f;                  // direction components below this share of the largest are lifted to it

// A ray prepared for slab tests: plane p is met at p * inverse + bias.
struct BoxRay {
    vec3 inverse;
    vec3 biasLo;
    vec3 biasHi;
};

// A ray prepared for the triangle test.
struct TriangleRay {
    vec3 origin;
    uint axis;  // dominant axis of the direction
    vec3 shear; // direction.x / direction.z, direction.y / direction.z, 1 / direction.z after the rotation of axes
};

HIPR_INLINE float largest(vec3 v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); }

HIPR_INLINE bool bounded(vec3 v) { return abs(v.x) <= 1e18f && abs(v.y) <= 1e18f && abs(v.z) <= 1e18f; } // false for NaN

// Rays that can hit something; all others miss in every traversal.
HIPR_INLINE bool traceable(vec3 origin, vec3 direction, float tMin, float tMax) {
    return bounded(origin) && bounded(direction) && largest(direction) > 1e-18f && tMin <= tMax;
}

// The affine map of a point.
HIPR_INLINE vec3 mapPoint(mat4x3 m, vec3 p) {
    HIPR_PRECISE vec3 r;
    r.x = ((m[0].x * p.x + m[1].x * p.y) + m[2].x * p.z) + m[3].x;
    r.y = ((m[0].y * p.x + m[1].y * p.y) + m[2].y * p.z) + m[3].y;
    r.z = ((m[0].z * p.x + m[1].z * p.y) + m[2].z * p.z) + m[3].z;
    return r;
}

// The linear part of an affine map applied to a direction; its length is kept, so distances stay those of the world ray.
HIPR_INLINE vec3 mapDirection(mat4x3 m, vec3 d) {
    HIPR_PRECISE vec3 r;
    r.x = (m[0].x * d.x + m[1].x * d.y) + m[2].x * d.z;
    r.y = (m[0].y * d.x + m[1].y * d.y) + m[2].y * d.z;
    r.z = (m[0].z * d.x + m[1].z * d.y) + m[2].z * d.z;
    return r;
}

HIPR_INLINE float liftedInverse(float d, float least) {
    HIPR_PRECISE float lifted = max(abs(d), least);
    HIPR_PRECISE float inverse = 1.0f / lifted;
    return d < 0.0f ? -inverse : inverse;
}

// What rounding may move a ray by, as a length in the ray's space; `extent` is the largest |coordinate| of what it meets.
HIPR_INLINE float rayAllowance(vec3 origin, float extent) {
    HIPR_PRECISE float allowance = (largest(origin) + extent) * BOX_ALLOWANCE;
    return allowance;
}

// `extent` is the largest |coordinate| of the boxes to be tested.
HIPR_INLINE BoxRay boxRay(vec3 origin, vec3 direction, float extent) {
    HIPR_PRECISE float least = largest(direction) * AXIS_RATIO;
    HIPR_PRECISE float allowance = rayAllowance(origin, extent);
    HIPR_PRECISE BoxRay r;
    r.inverse.x = liftedInverse(direction.x, least);
    r.inverse.y = liftedInverse(direction.y, least);
    r.inverse.z = liftedInverse(direction.z, least);
    r.biasLo.x = -(origin.x + allowance) * r.inverse.x;
    r.biasLo.y = -(origin.y + allowance) * r.inverse.y;
    r.biasLo.z = -(origin.z + allowance) * r.inverse.z;
    r.biasHi.x = (allowance - origin.x) * r.inverse.x;
    r.biasHi.y = (allowance - origin.y) * r.inverse.y;
    r.biasHi.z = (allowance - origin.z) * r.inverse.z;
    return r;
}

// Distances at which the ray enters and leaves a box; it misses when entry > exit.
HIPR_INLINE void boxInterval(BoxRay r, vec3 lo, vec3 hi, HIPR_OUT(float) entry, HIPR_OUT(float) exit) {
    HIPR_PRECISE float x0 = lo.x * r.inverse.x + r.biasLo.x;
    HIPR_PRECISE float y0 = lo.y * r.inverse.y + r.biasLo.y;
    HIPR_PRECISE float z0 = lo.z * r.inverse.z + r.biasLo.z;
    HIPR_PRECISE float x1 = hi.x * r.inverse.x + r.biasHi.x;
    HIPR_PRECISE float y1 = hi.y * r.inverse.y + r.biasHi.y;
    HIPR_PRECISE float z1 = hi.z * r.inverse.z + r.biasHi.z;
    entry = max(max(min(x0, x1), min(y0, y1)), min(z0, z1));
    exit = min(min(max(x0, x1), max(y0, y1)), max(z0, z1));
}

// Cyclic rotation of axes that brings `axis` to z and keeps the handedness.
HIPR_INLINE vec3 rotateAxes(vec3 v, uint axis) {
    return axis == 0u ? vec3(v.y, v.z, v.x) : (axis == 1u ? vec3(v.z, v.x, v.y) : v);
}

HIPR_INLINE TriangleRay triangleRay(vec3 origin, vec3 direction) {
    vec3 m = vec3(abs(direction.x), abs(direction.y), abs(direction.z));
    HIPR_PRECISE TriangleRay r;
    r.origin = origin;
    r.axis = m.z >= m.x && m.z >= m.y ? 2u : (m.x >= m.y ? 0u : 1u);
    vec3 d = rotateAxes(direction, r.axis);
    r.shear.z = 1.0f / d.z;
    r.shear.x = d.x * r.shear.z;
    r.shear.y = d.y * r.shear.z;
    return r;
}

// Signed distance t (unbounded, in units of the direction), the weights u, v of vertices b and c, and whether the ray comes
// from the side on which the vertices go round counter-clockwise. False: a miss, or the triangle is seen edge-on.
HIPR_INLINE bool intersectTriangle(TriangleRay r, vec3 a, vec3 b, vec3 c, HIPR_OUT(float) t, HIPR_OUT(float) u,
                                   HIPR_OUT(float) v, HIPR_OUT(bool) front) {
    HIPR_PRECISE vec3 pa = rotateAxes(a - r.origin, r.axis);
    HIPR_PRECISE vec3 pb = rotateAxes(b - r.origin, r.axis);
    HIPR_PRECISE vec3 pc = rotateAxes(c - r.origin, r.axis);
    HIPR_PRECISE float ax = pa.x - r.shear.x * pa.z;
    HIPR_PRECISE float ay = pa.y - r.shear.y * pa.z;
    HIPR_PRECISE float bx = pb.x - r.shear.x * pb.z;
    HIPR_PRECISE float by = pb.y - r.shear.y * pb.z;
    HIPR_PRECISE float cx = pc.x - r.shear.x * pc.z;
    HIPR_PRECISE float cy = pc.y - r.shear.y * pc.z;
    HIPR_PRECISE float wa = cx * by - cy * bx; // edge functions, the weights of a, b, c
    HIPR_PRECISE float wb = ax * cy - ay * cx;
    HIPR_PRECISE float wc = bx * ay - by * ax;
    HIPR_PRECISE float sum = (wa + wb) + wc;
    HIPR_PRECISE float scale = 1.0f / sum;
    HIPR_PRECISE float depth = (wa * pa.z + wb * pb.z) + wc * pc.z;
    t = (depth * scale) * r.shear.z;
    u = wb * scale;
    v = wc * scale;
    front = (sum > 0.0f) == (r.shear.z > 0.0f);
    bool inside = (wa >= 0.0f && wb >= 0.0f && wc >= 0.0f) || (wa <= 0.0f && wb <= 0.0f && wc <= 0.0f);
    return inside && sum != 0.0f;
}

// The canonical hit: intersectTriangle within the boxes. [entry, exit] is the interval of the instance's world box.
HIPR_INLINE bool canonicalHit(TriangleRay r, BoxRay box, vec3 a, vec3 b, vec3 c, float entry, float exit,
                              HIPR_OUT(float) t, HIPR_OUT(float) u, HIPR_OUT(float) v, HIPR_OUT(bool) front) {
    if (!intersectTriangle(r, a, b, c, t, u, v, front)) return false;
    float boxEntry, boxExit;
    boxInterval(box, min(min(a, b), c), max(max(a, b), c), boxEntry, boxExit);
    boxEntry = max(boxEntry, entry);
    boxExit = min(boxExit, exit);
    t = min(max(t, boxEntry), boxExit);
    return boxEntry <= boxExit;
}

// The sides of an instance's faces that a ray passes as if they were not there; `culled` and the result are INSTANCE_CULL_*.
HIPR_INLINE uint passedSides(uint culled, uint rayFlags) {
    bool passes = (rayFlags & RAY_OF_CAMERA) != 0u || (culled & INSTANCE_CULL_FOR_LIGHT) != 0u;
    return passes ? culled & (INSTANCE_CULL_BACK | INSTANCE_CULL_FRONT) : 0u;
}
HIPR_INLINE bool passesSide(uint passed, bool front) {
    return (passed & (front ? INSTANCE_CULL_FRONT : INSTANCE_CULL_BACK)) != 0u;
}

// Whether a hit lies on an edge of its triangle, where the neighbour has it too. (Beside an edge it is the triangle's
// alone, because neighbours see edge functions of opposite sign.)
HIPR_INLINE bool onEdge(float u, float v) { return min(min(u, v), 1.0f - u - v) <= 2.4e-7f; }

// Whether a hit comes before another: nearer, or as near with smaller ids.
HIPR_INLINE bool before(float t, uint instance, uint primitive, float t1, uint instance1, uint primitive1) {
    return t < t1 || (t == t1 && (instance < instance1 || (instance == instance1 && primitive < primitive1)));
}

HIPR_SHARED_END
#endif
