#include "renderer/geometry/curve_basis.h"

#include <algorithm>

namespace hipr::geometry {
namespace {

using Weights = std::array<float, 4>;

Weights linearWeights(float t) {
    return {1 - t, t, 0, 0};
}
Weights bezierWeights(float t) {
    const float s = 1 - t;
    return {s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t};
}
Weights bezierTangent(float t) {
    const float s = 1 - t;
    return {-3 * s * s, 3 * s * s - 6 * t * s, 6 * t * s - 3 * t * t, 3 * t * t};
}
Weights bsplineWeights(float t) {
    const float s = 1 - t;
    return {s * s * s / 6, (3 * t * t * t - 6 * t * t + 4) / 6, (3 * s * s * s - 6 * s * s + 4) / 6,
            t * t * t / 6};
}
Weights bsplineTangent(float t) {
    const float s = 1 - t;
    return {-s * s / 2, (3 * t * t - 4 * t) / 2, -(3 * s * s - 4 * s) / 2, t * t / 2};
}
Weights catmullRomWeights(float t) {
    return {((2 - t) * t - 1) * t / 2, ((3 * t - 5) * t * t + 2) / 2, ((4 - 3 * t) * t + 1) * t / 2,
            (t - 1) * t * t / 2};
}
Weights catmullRomTangent(float t) {
    return {((4 - 3 * t) * t - 1) / 2, (9 * t - 10) * t / 2, ((8 - 9 * t) * t + 1) / 2, (3 * t - 2) * t / 2};
}

/// Two control points that are not there: twice the end minus its neighbour (UsdGeomBasisCurves, "pinned").
void foldPhantom(Weights& weights, int phantom, int end, int neighbour) {
    weights[size_t(end)] += 2 * weights[size_t(phantom)];
    weights[size_t(neighbour)] -= weights[size_t(phantom)];
    weights[size_t(phantom)] = 0;
}

bool hasPhantoms(CurveBasis basis, CurveWrap wrap) {
    return wrap == CurveWrap::Pinned && (basis == CurveBasis::BSpline || basis == CurveBasis::CatmullRom);
}

} // namespace

uint32_t segmentCount(CurveBasis basis, CurveWrap wrap, uint32_t count) {
    const bool closed = wrap == CurveWrap::Periodic;
    switch (basis) {
    case CurveBasis::Linear:
        if (wrap == CurveWrap::Segments) return count / 2;
        if (closed) return count > 2 ? count : 0;
        return count > 1 ? count - 1 : 0;
    case CurveBasis::Bezier:
        if (closed) return count / 3;
        return count > 3 ? (count - 1) / 3 : 0;
    case CurveBasis::BSpline:
    case CurveBasis::CatmullRom:
        break;
    }
    if (closed) return count > 2 ? count : 0;
    if (hasPhantoms(basis, wrap)) return count > 1 ? count - 1 : 0;
    return count > 3 ? count - 3 : 0;
}

uint32_t varyingCount(CurveBasis basis, CurveWrap wrap, uint32_t count) {
    const uint32_t segments = segmentCount(basis, wrap, count);
    if (wrap == CurveWrap::Segments) return 2 * segments;
    return wrap == CurveWrap::Periodic || segments == 0 ? segments : segments + 1;
}

CurveSample sampleCurve(CurveBasis basis, CurveWrap wrap, uint32_t count, uint32_t segment, float t) {
    CurveSample sample;
    sample.t = t;
    const uint32_t firstVarying = wrap == CurveWrap::Segments ? 2 * segment : segment;
    sample.varying = {firstVarying, (firstVarying + 1) % varyingCount(basis, wrap, count)};
    uint32_t first = segment, points = 4;
    switch (basis) {
    case CurveBasis::Linear:
        sample.weight = linearWeights(t);
        sample.tangent = {-1, 1, 0, 0};
        first = wrap == CurveWrap::Segments ? 2 * segment : segment;
        points = 2;
        break;
    case CurveBasis::Bezier:
        sample.weight = bezierWeights(t);
        sample.tangent = bezierTangent(t);
        first = 3 * segment;
        break;
    case CurveBasis::BSpline:
        sample.weight = bsplineWeights(t);
        sample.tangent = bsplineTangent(t);
        break;
    case CurveBasis::CatmullRom:
        sample.weight = catmullRomWeights(t);
        sample.tangent = catmullRomTangent(t);
        break;
    }
    const bool phantoms = hasPhantoms(basis, wrap); // then the segment's second point is `segment`
    for (uint32_t i = 0; i < points; ++i) {
        const uint32_t index = first + i;
        if (!phantoms)
            sample.point[i] = index % count;
        else
            sample.point[i] = index == 0 ? 0 : std::min(index - 1, count - 1);
    }
    for (Weights* weights : {&sample.weight, &sample.tangent}) {
        if (phantoms && segment == 0) foldPhantom(*weights, 0, 1, 2);
        if (phantoms && segment + 2 == count) foldPhantom(*weights, 3, 2, 1);
    }
    return sample;
}

} // namespace hipr::geometry

size_t hipr::varyingCount(const CurvesDesc& desc) {
    size_t sum = 0;
    for (const int count : desc.vertexCounts)
        sum += geometry::varyingCount(desc.basis, desc.wrap, uint32_t(std::max(count, 0)));
    return sum;
}
