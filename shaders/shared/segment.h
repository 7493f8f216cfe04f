// Round segments, of which curves are made: what a sphere sweeps that goes from one vertex to the next while its radius
// changes evenly; a cone with spherical ends. Compiled as GLSL and as C++ with the same operations in the same order, as
// the triangle test of intersect.h, whose rules on boxes hold here too. A square root and reciprocals are all they need.
//
// A segment is met where a ray comes in, and nowhere else: it is convex, so there is one such place, and that it has no
// inside makes joints of segments, which lie in one another, as good as one surface for whatever comes from outside. So a
// ray that passes front faces passes segments.
//
// The equations of the cone are written with the parts of vectors across its axis, and discriminants with cross products,
// for segments are thousands of times as long as they are thick: differences of squares of lengths have no digits left.
#ifndef HIPR_SHARED_SEGMENT_H
#define HIPR_SHARED_SEGMENT_H
#include "intersect.h"
#include "motion.h"
HIPR_SHARED_BEGIN
#ifdef __cplusplus
using glm::clamp;
using std::sqrt;
#endif

// A ray prepared for the test.
struct SegmentRay {
    vec3 origin;
    vec3 direction;  // unit length
    float perLength; // what a unit of length adds to the ray's distance
};

// What one segment of vertices a and b is, but for where.
struct SegmentShape {
    vec3 axis;           // from a to b, unit length
    float inverseLength; // 0: the vertices are one
    float slope;         // sine of half the cone's angle, positive where it becomes thinner; +-1: one end holds the other
};

HIPR_INLINE float dotRounded(vec3 a, vec3 b) {
    HIPR_PRECISE float sum = (a.x * b.x + a.y * b.y) + a.z * b.z;
    return sum;
}

HIPR_INLINE SegmentRay segmentRay(vec3 origin, vec3 direction) {
    HIPR_PRECISE float perLargest = 1.0f / largest(direction); // squares of tiny numbers are none
    HIPR_PRECISE vec3 scaled = direction * perLargest;
    HIPR_PRECISE float inverse = 1.0f / sqrt(dotRounded(scaled, scaled));
    HIPR_PRECISE SegmentRay r;
    r.origin = origin;
    r.direction = scaled * inverse;
    r.perLength = perLargest * inverse;
    return r;
}

HIPR_INLINE SegmentShape segmentShape(vec3 a, vec3 b, float radiusA, float radiusB) {
    HIPR_PRECISE vec3 along = b - a;
    HIPR_PRECISE float squared = dotRounded(along, along);
    HIPR_PRECISE SegmentShape s;
    s.axis = vec3(0.0f, 0.0f, 1.0f);
    s.inverseLength = 0.0f;
    s.slope = radiusA >= radiusB ? 1.0f : -1.0f;
    if (squared > 1e-30f) {
        s.inverseLength = 1.0f / sqrt(squared);
        s.axis = along * s.inverseLength;
        s.slope = clamp((radiusA - radiusB) * s.inverseLength, -1.0f, 1.0f);
    }
    return s;
}

// Two unit vectors across a unit vector: Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
HIPR_INLINE void acrossAxis(vec3 d, HIPR_OUT(vec3) x, HIPR_OUT(vec3) y) {
    HIPR_PRECISE float s = d.z < 0.0f ? -1.0f : 1.0f;
    HIPR_PRECISE float a = -1.0f / (s + d.z);
    HIPR_PRECISE float b = d.x * d.y * a;
    HIPR_PRECISE vec3 first = vec3(1.0f + s * d.x * d.x * a, s * b, -s * d.x);
    HIPR_PRECISE vec3 second = vec3(b, s + d.y * d.y * a, -d.y);
    x = first;
    y = second;
}

// The box of a segment.
HIPR_INLINE vec3 segmentLo(vec3 a, vec3 b, float radiusA, float radiusB) {
    HIPR_PRECISE vec3 lo = min(a - vec3(radiusA), b - vec3(radiusB));
    return lo;
}
HIPR_INLINE vec3 segmentHi(vec3 a, vec3 b, float radiusA, float radiusB) {
    HIPR_PRECISE vec3 hi = max(a + vec3(radiusA), b + vec3(radiusB));
    return hi;
}

// A direction in the plane as a number from 0 to 1 that grows with its angle: a place on the square |x| + |y| = 1.
HIPR_INLINE float turnOf(float x, float y) {
    HIPR_PRECISE float size = abs(x) + abs(y);
    if (!(size > 0.0f)) return 0.0f;
    HIPR_PRECISE float share = y * (1.0f / size);
    HIPR_PRECISE float quarters = x < 0.0f ? 2.0f - share : (share < 0.0f ? 4.0f + share : share);
    HIPR_PRECISE float turn = 0.25f * quarters;
    return turn;
}

// The unit vector that has a turn.
HIPR_INLINE vec2 ofTurn(float turn) {
    HIPR_PRECISE float quarters = 4.0f * turn;
    HIPR_PRECISE float y = quarters <= 1.0f ? quarters : (quarters <= 3.0f ? 2.0f - quarters : quarters - 4.0f);
    HIPR_PRECISE float x = 1.0f - abs(y);
    HIPR_PRECISE float inverse = 1.0f / sqrt(x * x + y * y);
    if (quarters > 1.0f && quarters < 3.0f) x = -x;
    return vec2(x * inverse, y * inverse);
}

// Where the ray comes into a segment: the signed distance t (unbounded, in units of the ray's direction), and the point.
// u: 0 at the first vertex to 1 at the second, of the sphere that touches the surface there; on the spherical ends beyond
// that, by how much the normal's cosine with the axis differs from that of the cone. v: the turn around the axis, 0 to 1.
HIPR_INLINE bool intersectSegment(SegmentRay r, vec3 a, vec3 b, float radiusA, float radiusB, HIPR_OUT(float) t,
                                  HIPR_OUT(float) u, HIPR_OUT(float) v) {
    t = u = v = 0.0f;
    SegmentShape s = segmentShape(a, b, radiusA, radiusB);
    HIPR_PRECISE vec3 along = b - a;
    HIPR_PRECISE vec3 from = r.origin - a;
    // From the point of the ray next to the middle on, so that everything else has the size of the segment.
    HIPR_PRECISE vec3 toMiddle = along * 0.5f - from;
    HIPR_PRECISE float start = dotRounded(toMiddle, r.direction);
    from = from + r.direction * start;

    HIPR_PRECISE float height = dotRounded(from, s.axis);
    HIPR_PRECISE float climb = dotRounded(r.direction, s.axis);
    HIPR_PRECISE vec3 p = from - s.axis * height;
    HIPR_PRECISE vec3 q = r.direction - s.axis * climb;
    HIPR_PRECISE float local = 0.0f;
    HIPR_PRECISE float place = 0.0f; // along the axis, of the sphere that touches
    HIPR_PRECISE float cosine2 = 1.0f - s.slope * s.slope;
    bool onCone = false;
    bool atFirst = radiusA >= radiusB; // else the other end
    if (cosine2 > 1e-6f) {
        // The cone's radius at the ray is k + local * g, its distance from the axis |p + local * q|.
        HIPR_PRECISE float inverseCosine = 1.0f / sqrt(cosine2);
        HIPR_PRECISE float k = (radiusA - s.slope * height) * inverseCosine;
        HIPR_PRECISE float g = -((s.slope * climb) * inverseCosine);
        HIPR_PRECISE vec3 m = q * k - p * g;
        HIPR_PRECISE float twist = dotRounded(crossRounded(p, q), s.axis);
        HIPR_PRECISE float discriminant = dotRounded(m, m) - twist * twist;
        if (!(discriminant >= 0.0f)) return false; // spheres lie in their cone
        HIPR_PRECISE float root = sqrt(discriminant);
        HIPR_PRECISE float square = dotRounded(q, q) - g * g;
        HIPR_PRECISE float linear = dotRounded(p, q) - k * g;
        HIPR_PRECISE float constant = dotRounded(p, p) - k * k;
        HIPR_PRECISE float divisor = linear >= 0.0f ? square : root - linear;
        HIPR_PRECISE float share = linear >= 0.0f ? -(linear + root) : constant;
        local = share * (1.0f / divisor);
        place = (height + local * climb - s.slope * radiusA) * (inverseCosine * inverseCosine);
        u = place * s.inverseLength;
        onCone = u >= 0.0f && u <= 1.0f;
        // A ray comes in by an end where it meets the cone beyond it; one that is in the cone from infinity on (it meets
        // the cone behind its tip, or nowhere) comes in by the thick end, or the one it goes away from.
        if (k + local * g < 0.0f)
            atFirst = s.slope > 0.0f;
        else
            atFirst = u < 0.0f || (!(u > 1.0f) && climb > 0.0f);
    }
    if (!onCone) {
        HIPR_PRECISE vec3 fromEnd = from;
        if (!atFirst) fromEnd = from - along;
        HIPR_PRECISE float radius = atFirst ? radiusA : radiusB;
        HIPR_PRECISE vec3 offset = crossRounded(fromEnd, r.direction);
        HIPR_PRECISE float inside = radius * radius - dotRounded(offset, offset);
        if (!(inside >= 0.0f) || !(radius > 0.0f)) return false;
        local = -(dotRounded(fromEnd, r.direction) + sqrt(inside));
        HIPR_PRECISE vec3 out_ = fromEnd + r.direction * local;
        HIPR_PRECISE float beyond = dotRounded(out_, s.axis) * (1.0f / radius) - s.slope;
        u = atFirst ? min(beyond, 0.0f) : 1.0f + max(beyond, 0.0f);
    }
    vec3 x, y;
    acrossAxis(s.axis, x, y);
    HIPR_PRECISE vec3 across = p + q * local;
    v = turnOf(dotRounded(across, x), dotRounded(across, y));
    HIPR_PRECISE float distance_ = (start + local) * r.perLength;
    t = distance_;
    return true;
}

// The canonical hit: intersectSegment within the boxes, as canonicalHit() of triangles.
HIPR_INLINE bool canonicalSegmentHit(SegmentRay r, BoxRay box, vec3 a, vec3 b, float radiusA, float radiusB, float entry,
                                     float exit, HIPR_OUT(float) t, HIPR_OUT(float) u, HIPR_OUT(float) v) {
    float boxEntry, boxExit;
    boxInterval(box, segmentLo(a, b, radiusA, radiusB), segmentHi(a, b, radiusA, radiusB), boxEntry, boxExit);
    boxEntry = max(boxEntry, entry);
    boxExit = min(boxExit, exit);
    if (!(boxEntry <= boxExit) || !intersectSegment(r, a, b, radiusA, radiusB, t, u, v)) {
        t = u = v = 0.0f;
        return false;
    }
    t = min(max(t, boxEntry), boxExit);
    return true;
}

// A point of a segment's surface.
struct SegmentPoint {
    vec3 position;
    vec3 normal;  // outwards, unit length
    vec3 across;  // the same of a cylinder around the axis
    vec3 axis;    // unit length
    float along;  // 0..1, the weight of the second vertex
    float radius;
    float slope;  // of the cone
};

// Where intersectSegment() has found u and v.
HIPR_INLINE SegmentPoint segmentPoint(vec3 a, vec3 b, float radiusA, float radiusB, float u, float v) {
    SegmentShape s = segmentShape(a, b, radiusA, radiusB);
    SegmentPoint point;
    vec3 x, y;
    acrossAxis(s.axis, x, y);
    vec2 turn = ofTurn(v);
    point.axis = s.axis;
    point.slope = s.slope;
    point.along = clamp(u, 0.0f, 1.0f);
    point.across = x * turn.x + y * turn.y;
    point.radius = radiusA + (radiusB - radiusA) * point.along;
    float cosine = clamp(s.slope + (u - point.along), -1.0f, 1.0f);
    point.normal = s.axis * cosine + point.across * sqrt(max(1.0f - cosine * cosine, 0.0f));
    point.position = (a + (b - a) * point.along) + point.normal * point.radius;
    return point;
}

HIPR_SHARED_END
#endif
