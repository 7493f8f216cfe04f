/// @file curve_basis.h
/// Control points to points on curves. Internal to renderer/geometry.
#pragma once

#include <array>

#include "renderer/api/curves.h"

namespace hipr::geometry {

/// A weighted sum of control points of one curve, by index.
struct CurveSample {
    std::array<uint32_t, 4> point{};
    std::array<float, 4> weight{};  ///< sum 1
    std::array<float, 4> tangent{}; ///< weights of the derivative, sum 0
    std::array<uint32_t, 2> varying{}; ///< values at the ends of the segment
    float t = 0.f;                     ///< within the segment
};

/// Segments of a curve of `count` control points; 0: too few.
uint32_t segmentCount(CurveBasis basis, CurveWrap wrap, uint32_t count);

/// Values of a varying primvar on such a curve: one a segment's end, the first and last of a closed curve
/// being one.
uint32_t varyingCount(CurveBasis basis, CurveWrap wrap, uint32_t count);

/// A point of a curve, `segment` below segmentCount(), t in [0, 1].
CurveSample sampleCurve(CurveBasis basis, CurveWrap wrap, uint32_t count, uint32_t segment, float t);

} // namespace hipr::geometry
