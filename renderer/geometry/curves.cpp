#include <cmath>
#include <set>

#include "renderer/geometry/curve_builder.h"
#include "renderer/geometry/finish.h"

namespace hipr {
namespace geometry {
namespace {

constexpr size_t ManyTriangles = size_t(16) << 20;
constexpr int MaxLevel = 8;

/// Whether lengths between such points can be told from infinity.
bool drawable(const glm::vec3& point) {
    return glm::all(glm::lessThanEqual(glm::abs(point), glm::vec3(LargestCoordinate)));
}

/// Whether every element has a finite value.
bool fits(const Primvar& primvar, size_t elements) {
    const size_t values = primvar.components ? primvar.values.size() / primvar.components : 0;
    if (!std::all_of(primvar.values.begin(), primvar.values.end(), [](float v) { return std::isfinite(v); }))
        return false;
    if (primvar.indices.empty()) return values >= elements;
    return primvar.indices.size() >= elements &&
           std::all_of(primvar.indices.begin(), primvar.indices.end(),
                       [&](int index) { return index >= 0 && size_t(index) < values; });
}

} // namespace

std::shared_ptr<TriangleMesh> CurveBuilder::build() {
    findCurves();
    findPrimvars();
    const bool told = _desc.form && (!_desc.form->round || _desc.form->steps.size() == _segmentCount);
    _form = told ? *_desc.form : chooseForm();
    if (!_form.round) chooseDetail();
    for (const Curve& curve : _curves)
        addCurve(curve);
    for (TrianglePrimvar& primvar : _mesh->primvars)
        if (primvar.interpolation == Interpolation::Uniform && !_form.round) spreadUniform(primvar);
    setBounds(*_mesh);
    return _mesh;
}

void CurveBuilder::findCurves() {
    const size_t controls = _desc.pointIndices.empty() ? _desc.points.size() : _desc.pointIndices.size();
    size_t first = 0, tooFew = 0, beyond = 0, broken = 0;
    const std::set<int> hidden(_desc.hiddenCurves.begin(), _desc.hiddenCurves.end());
    for (size_t i = 0; i < _desc.vertexCounts.size(); ++i) {
        const int count = std::max(_desc.vertexCounts[i], 0);
        const Curve curve{uint32_t(i), uint32_t(first), uint32_t(count), _varyingCount, _segmentCount};
        first += size_t(count);
        const bool fits = first <= controls; // else the sums may be too large for 32 bits
        const uint32_t segments = segmentsOf(curve);
        if (fits) {
            _varyingCount += varyingOf(curve);
            _segmentCount += segments;
        }
        const auto all = [&](auto good) {
            for (uint32_t p = curve.first; p < curve.first + curve.count; ++p)
                if (!good(p)) return false;
            return true;
        };
        if (hidden.count(int(i))) continue;
        if (segments == 0)
            ++tooFew;
        else if (!fits || !all([&](uint32_t p) { return exists(p); }))
            ++beyond;
        else if (!all([&](uint32_t p) { return drawable(control(p)); }))
            ++broken;
        else
            _curves.push_back(curve);
    }
    const auto tell = [&](size_t count, const char* why) {
        if (count)
            warn(_messages, _desc.name,
                 std::to_string(count) + (count == 1 ? " curve" : " curves") + " dropped: " + why);
    };
    tell(tooFew, "too few control points for their basis");
    tell(beyond, "their control points are beyond the end of the points");
    tell(broken, "control points that are NaN, infinite or above 1e18");
}

void CurveBuilder::findPrimvars() {
    for (const Primvar& primvar : _desc.primvars) {
        const CurvePrimvar candidate(primvar, _desc.pointIndices);
        const size_t elements = candidate.varying()                               ? _varyingCount
                                : candidate.perPoint()                            ? _desc.points.size()
                                : primvar.interpolation == Interpolation::Uniform ? _desc.vertexCounts.size()
                                                                                  : 1;
        if (!fits(primvar, elements)) {
            warn(_messages, _desc.name,
                 "primvar '" + primvar.name + "' dropped: it lacks values, or some are no numbers");
            continue;
        }
        if (primvar.name == "widths" && primvar.components == 1) {
            _widths = std::make_unique<CurvePrimvar>(candidate);
        } else if (primvar.name == "normals" && primvar.components == 3) {
            _normals = std::make_unique<CurvePrimvar>(candidate);
        } else if (primvar.components >= 1 && primvar.components <= 4) {
            const bool perVertex = candidate.varying() || candidate.perPoint();
            if (perVertex) _targets.push_back(_mesh->primvars.size());
            if (perVertex) _primvars.push_back(candidate);
            TrianglePrimvar target{primvar.name,
                                   perVertex ? Interpolation::Vertex : primvar.interpolation,
                                   primvar.components,
                                   {}};
            for (size_t i = 0; i < (perVertex ? 0 : elements); ++i) {
                const size_t value = primvar.indices.empty() ? i : size_t(primvar.indices[i]);
                const float* from = &primvar.values[value * primvar.components];
                target.values.insert(target.values.end(), from, from + primvar.components);
            }
            _mesh->primvars.push_back(std::move(target));
        }
    }
}

void CurveBuilder::chooseDetail() {
    const int level = std::clamp(_desc.refineLevel, 0, MaxLevel);
    size_t segments = 0;
    for (const Curve& curve : _curves)
        segments += segmentsOf(curve);
    const int few = segments <= FewCurveSegments ? 8 : 4; // steps
    _steps = _desc.basis == CurveBasis::Linear ? 1 : few << level;
    _sides = 16u << std::min(level, 2);
    for (const uint32_t fewer : {8u, 4u, 3u})
        if (segments * size_t(_steps) * 2 * _sides > ManyTriangles && fewer < _sides) _sides = fewer;
    _caps = _sides > 4;
}

void CurveBuilder::addCurve(const Curve& curve) {
    const auto addStrand = [&](const std::vector<CurveSample>& samples) {
        _form.round ? addSegments(curve, samples)
        : _normals  ? addRibbon(curve, samples)
                    : addTube(curve, samples);
    };
    if (_desc.wrap != CurveWrap::Segments) return addStrand(samplesOf(curve, 0, segmentsOf(curve)));
    for (uint32_t segment = 0; segment < segmentsOf(curve); ++segment)
        addStrand(samplesOf(curve, segment, 1));
}

std::vector<CurveSample> CurveBuilder::samplesOf(const Curve& curve, uint32_t firstSegment,
                                                 uint32_t segments) const {
    std::vector<CurveSample> samples;
    for (uint32_t segment = firstSegment; segment < firstSegment + segments; ++segment) {
        const int steps = _form.round ? _form.steps[curve.firstSegment + segment] : _steps;
        for (int step = 0; step < steps; ++step)
            samples.push_back(sampleAt(curve, segment, float(step) / float(steps)));
    }
    samples.push_back(sampleAt(curve, firstSegment + segments - 1, 1.f));
    return samples;
}

void CurveBuilder::addPrimvars(const Curve& curve, const CurveSample& sample) {
    for (size_t i = 0; i < _primvars.size(); ++i) {
        float values[4];
        _primvars[i].evaluate(curve, sample, values);
        TrianglePrimvar& target = _mesh->primvars[_targets[i]];
        target.values.insert(target.values.end(), values, values + target.components);
    }
}

/// From one value a curve to one a triangle.
void CurveBuilder::spreadUniform(TrianglePrimvar& primvar) const {
    std::vector<float> spread;
    spread.reserve(_mesh->triangleFace.size() * primvar.components);
    for (const uint32_t curve : _mesh->triangleFace) {
        const float* value = &primvar.values[size_t(curve) * primvar.components];
        spread.insert(spread.end(), value, value + primvar.components);
    }
    primvar.values = std::move(spread);
}

} // namespace geometry

std::shared_ptr<const TriangleMesh> buildCurves(const CurvesDesc& desc, const MessageSink& messages) {
    return geometry::orEmptyMesh(desc.name, messages,
                                 [&] { return geometry::CurveBuilder(desc, messages).build(); });
}

CurveForm curveForm(const CurvesDesc& desc) {
    return geometry::CurveBuilder(desc, [](Severity, const std::string&, const std::string&) {}).form();
}

} // namespace hipr
