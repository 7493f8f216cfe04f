// Which tiles the ellipse of a splat meets: exact, tile row by tile row. Compiled as GLSL and as C++.
//
// Points at distance d from the mean belong to the ellipse if (a d.x + b d.y)^2 + (c d.y)^2 <= reach, where a, b, c are
// ProjectedSplat::shape. On the line d.y = y it spans x = (-b y -/+ sqrt(reach - (c y)^2)) / a; that is largest at
// y = -b / c * sqrt(reach / (b^2 + c^2)) and smallest at the point opposite. A convex shape meets a row of tiles exactly
// in those between its least and its largest x within the row. (The method: A. Hanson et al., "Speedy-Splat", CVPR 2025,
// and AccuTile; docs/higs.md.)
#ifndef HIPR_SHARED_HIGS_ELLIPSE_H
#define HIPR_SHARED_HIGS_ELLIPSE_H
#include "higs.h"
HIPR_SHARED_BEGIN
#ifdef __cplusplus
using glm::clamp;
using glm::max;
using glm::min;
using std::sqrt;
#endif

// Rounding of sigma must not put a pixel that contributes outside.
HIPR_CONST float REACH_ALLOWANCE = 1e-3f;

// Not positive for splats that are not seen.
HIPR_INLINE float splatReach(float bias) {
    return bias < SPLAT_SIGMA_LIMIT ? SPLAT_SIGMA_LIMIT - bias + REACH_ALLOWANCE : 0.0f;
}

struct SplatEllipse {
    vec2 mean;
    float inverseA;
    float slope;     // -b / a: how far the middle of the spans moves with y
    float c;
    float reach;
    vec2 half_;      // half the edges of the box around it
    float turn;      // y of the largest x
};

HIPR_INLINE SplatEllipse splatEllipse(vec2 mean, vec3 shape, float reach) {
    SplatEllipse e;
    e.mean = mean;
    e.inverseA = 1.0f / shape.x;
    e.slope = -shape.y * e.inverseA;
    e.c = shape.z;
    e.reach = reach;
    float length_ = sqrt(shape.y * shape.y + shape.z * shape.z);
    e.half_.y = sqrt(reach) / shape.z;
    e.half_.x = e.half_.y * length_ * e.inverseA;
    e.turn = -e.half_.y * shape.y / length_;
    return e;
}

HIPR_INLINE float halfSpan(SplatEllipse e, float y) {
    float v = e.c * y;
    return sqrt(max(e.reach - v * v, 0.0f)) * e.inverseA;
}

// Least and largest x of the part of the ellipse between the lines y = lo and y = hi, which must meet it.
HIPR_INLINE vec2 ellipseSpan(SplatEllipse e, float lo, float hi) {
    float from = max(lo - e.mean.y, -e.half_.y);
    float to = min(hi - e.mean.y, e.half_.y);
    float right = clamp(e.turn, from, to);
    float left = clamp(-e.turn, from, to);
    return vec2(e.mean.x + e.slope * left - halfSpan(e, left), e.mean.x + e.slope * right + halfSpan(e, right));
}

// Tiles of a row, or rows, that an interval meets: from .x to before .y. Tiles have closed edges: touching is meeting.
HIPR_INLINE uvec2 tilesOfSpan(float lo, float hi, float tile, uint first, uint end) {
    float inverse_ = 1.0f / tile; // exact: edges of tiles are powers of two
    float from = clamp(floor(lo * inverse_), float(first), float(end));
    float to = clamp(floor(hi * inverse_) + 1.0f, float(first), float(end));
    return uvec2(uint(from), uint(max(from, to)));
}

HIPR_SHARED_END
#endif
