// Curves as round segments.
#include <cmath>

#include "renderer/geometry/curve_builder.h"

namespace hipr::geometry {
namespace {

constexpr float ThinLength = 100.f; ///< of curves, in widths
constexpr int MostSteps = 4;        ///< of a segment at level 0
constexpr int MostLevels = 4;       ///< that double them
constexpr float WidthBend = 0.125f,
                LengthBend = 0.01f; ///< shares of width and length that a step may be off by

} // namespace

CurveForm CurveBuilder::form() {
    findCurves();
    findPrimvars();
    return chooseForm();
}

/// Whether they are long for their width, on average.
bool CurveBuilder::thin() const {
    double length = 0.0, width = 0.0;
    for (const Curve& curve : _curves) {
        for (uint32_t i = curve.first; i + 1 < curve.first + curve.count; ++i)
            length += glm::length(control(i + 1) - control(i));
        width += radius(curve, sampleAt(curve, 0, 0.f)) +
                 radius(curve, sampleAt(curve, segmentsOf(curve) - 1, 1.f));
    }
    return length > ThinLength * width;
}

/// By how much the segment's second derivative lets a straight line differ from it.
int CurveBuilder::stepsOf(const Curve& curve, uint32_t segment) const {
    if (_desc.basis == CurveBasis::Linear) return 1;
    const CurveSample from = sampleAt(curve, segment, 0.f), to = sampleAt(curve, segment, 1.f);
    const glm::vec3 chord = position(curve, to) - position(curve, from);
    const glm::vec3 leaving = pointAt(curve, from.tangent, from), arriving = pointAt(curve, to.tangent, to);
    // It is linear in between for a cubic.
    const float bend = std::max(glm::length(6.f * chord - 4.f * leaving - 2.f * arriving),
                                glm::length(2.f * leaving + 4.f * arriving - 6.f * chord));
    const float width = radius(curve, from) + radius(curve, to);
    const float off = std::ldexp(std::max(WidthBend * width, LengthBend * glm::length(chord)),
                                 -2 * std::clamp(_desc.refineLevel, 0, MostLevels));
    const float steps = std::ceil(std::sqrt(bend / (8.f * std::max(off, 1e-30f))));
    const float most = float(MostSteps << std::clamp(_desc.refineLevel, 0, MostLevels));
    return int(std::min(std::max(1.f, steps), most)); // in this order 1 for lengths that overflow to NaN
}

CurveForm CurveBuilder::chooseForm() const {
    CurveForm form;
    size_t segments = 0;
    for (const Curve& curve : _curves)
        segments += segmentsOf(curve);
    form.round = !_normals && (segments > FewCurveSegments || thin());
    if (!form.round) return form;
    form.steps.assign(_segmentCount, 1);
    for (const Curve& curve : _curves)
        for (uint32_t segment = 0; segment < segmentsOf(curve); ++segment)
            form.steps[curve.firstSegment + segment] = uint8_t(stepsOf(curve, segment));
    return form;
}

void CurveBuilder::addSegmentVertex(const Curve& curve, const CurveSample& sample,
                                    const glm::vec3& position) {
    _mesh->positions.push_back(position);
    _mesh->radii.push_back(radius(curve, sample));
    addPrimvars(curve, sample);
}

void CurveBuilder::addSegments(const Curve& curve, const std::vector<CurveSample>& samples) {
    _mesh->doubleSided = true;
    const bool closed = _desc.wrap == CurveWrap::Periodic;
    const CurveSample &first = samples.front(), &last = samples.back();
    addSegmentVertex(curve, first, position(curve, closed ? samples[samples.size() - 2] : first));
    for (const CurveSample& sample : samples) {
        if (&sample != &last) {
            _mesh->segments.push_back(uint32_t(_mesh->positions.size()));
            _mesh->triangleFace.push_back(curve.index);
        }
        addSegmentVertex(curve, sample, position(curve, sample));
    }
    addSegmentVertex(curve, last, position(curve, closed ? samples[1] : last));
}

} // namespace hipr::geometry
