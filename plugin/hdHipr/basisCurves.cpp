#include "plugin/hdHipr/basisCurves.h"

#include <algorithm>

#include "plugin/hdHipr/messages.h"
#include "pxr/base/tf/stringUtils.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

/// Lines that stand for models (bounds, axes) are this much of their extent.
constexpr float lineWidth = 1.f / 400;

hipr::CurveBasis basisOf(HdBasisCurvesTopology const& topology) {
    if (topology.GetCurveType() != HdTokens->cubic) {
        return hipr::CurveBasis::Linear;
    }
    if (TfStringToLower(topology.GetCurveBasis().GetString()) == "bspline") { // versions differ in the token
        return hipr::CurveBasis::BSpline;
    }
    return topology.GetCurveBasis() == HdTokens->catmullRom ? hipr::CurveBasis::CatmullRom
                                                            : hipr::CurveBasis::Bezier;
}

hipr::CurveWrap wrapOf(HdBasisCurvesTopology const& topology) {
    static const TfToken pinned("pinned");
    if (topology.GetCurveWrap() == HdTokens->periodic) {
        return hipr::CurveWrap::Periodic;
    }
    if (topology.GetCurveWrap() == HdTokens->segmented) {
        return hipr::CurveWrap::Segments;
    }
    return topology.GetCurveWrap() == pinned ? hipr::CurveWrap::Pinned : hipr::CurveWrap::Nonperiodic;
}

std::vector<int> ints(VtIntArray const& array) {
    return {array.cdata(), array.cdata() + array.size()};
}

/// Of the points that are numbers.
float extentOf(std::vector<glm::vec3> const& points) {
    std::optional<std::pair<glm::vec3, glm::vec3>> box;
    for (glm::vec3 const& point : points) {
        if (finite(point)) {
            box = box ? std::pair(glm::min(box->first, point), glm::max(box->second, point))
                      : std::pair(point, point);
        }
    }
    return box ? glm::length(box->second - box->first) : 0.f;
}

/// UsdImaging gives lines that stand for models the width 1, whatever their size.
void setLineWidth(hipr::CurvesDesc& desc) {
    const auto isWidths = [](hipr::Primvar const& primvar) { return HdTokens->widths == primvar.name; };
    desc.primvars.erase(std::remove_if(desc.primvars.begin(), desc.primvars.end(), isWidths),
                        desc.primvars.end());
    desc.width = lineWidth * extentOf(desc.points);
}

} // namespace

std::shared_ptr<const hipr::TriangleMesh> HdHiprBasisCurves::readShape(HdSceneDelegate& delegate) {
    const HdBasisCurvesTopology topology = GetBasisCurvesTopology(&delegate);
    _desc = {};
    hipr::CurvesDesc& desc = _desc;
    desc.name = GetId().GetString();
    desc.basis = basisOf(topology);
    desc.wrap = wrapOf(topology);
    desc.vertexCounts = ints(topology.GetCurveVertexCounts());
    desc.pointIndices = ints(topology.GetCurveIndices());
    desc.hiddenCurves = ints(topology.GetInvisibleCurves());
    desc.refineLevel = GetDisplayStyle(&delegate).refineLevel;
    desc.points = readPoints(delegate);
    desc.primvars = readPrimvars(delegate, [&](HdInterpolation interpolation) {
        switch (interpolation) {
        case HdInterpolationUniform:
            return desc.vertexCounts.size();
        case HdInterpolationVertex:
            return desc.points.size();
        case HdInterpolationConstant:
            return size_t(1);
        default:
            return hipr::varyingCount(desc);
        }
    });
    if (desc.wrap == hipr::CurveWrap::Segments) {
        setLineWidth(desc);
    }
    return hipr::buildCurves(desc, report);
}

std::shared_ptr<const hipr::TriangleMesh> HdHiprBasisCurves::shapeOf(VtValue const& points) {
    if (!_desc.form) { // so that all shapes have as many vertices
        _desc.form = hipr::curveForm(_desc);
    }
    hipr::CurvesDesc desc = _desc;
    desc.points = toVec3s(points);
    return hipr::buildCurves(desc, report);
}

PXR_NAMESPACE_CLOSE_SCOPE
