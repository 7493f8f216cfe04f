#include <algorithm>
#include <cmath>
#include <set>

#include <glm/gtc/constants.hpp>

#include "renderer/geometry/cage.h"
#include "renderer/geometry/curve_basis.h"
#include "renderer/geometry/finish.h"
#include "renderer/geometry/normals.h"

namespace hipr {
namespace geometry {
namespace {

constexpr size_t ManyTriangles = size_t(16) << 20;
constexpr size_t FewSegments = 4096; ///< they may be thick
constexpr int MaxLevel = 8;

/// A curve that can be built.
struct Curve {
    uint32_t index;        ///< authored
    uint32_t first, count; ///< control points
    uint32_t firstVarying; ///< of its varying values
};

/// One of a curve's values at a sample.
class CurvePrimvar {
public:
    CurvePrimvar(const Primvar& primvar, const std::vector<int>& pointIndices)
        : _primvar(primvar), _pointIndices(pointIndices) {}

    const Primvar& primvar() const { return _primvar; }
    bool varying() const {
        return _primvar.interpolation == Interpolation::FaceVarying || (perPoint() && _primvar.linear);
    }
    bool perPoint() const { return _primvar.interpolation == Interpolation::Vertex; }

    void evaluate(const Curve& curve, const CurveSample& sample, float* out) const {
        std::fill_n(out, _primvar.components, 0.f);
        if (varying()) {
            add(curve.firstVarying + sample.varying[0], 1 - sample.t, out);
            add(curve.firstVarying + sample.varying[1], sample.t, out);
        } else if (perPoint()) {
            for (size_t i = 0; i < 4; ++i)
                if (sample.weight[i] != 0.f)
                    add(pointOf(curve.first + sample.point[i]), sample.weight[i], out);
        } else {
            add(_primvar.interpolation == Interpolation::Uniform ? curve.index : 0, 1.f, out);
        }
    }

private:
    uint32_t pointOf(uint32_t control) const {
        return _pointIndices.empty() ? control : uint32_t(_pointIndices[control]);
    }
    void add(uint32_t element, float weight, float* out) const {
        const size_t value = _primvar.indices.empty() ? element : size_t(_primvar.indices[element]);
        for (uint32_t c = 0; c < _primvar.components; ++c)
            out[c] += weight * _primvar.values[value * _primvar.components + c];
    }

    const Primvar& _primvar;
    const std::vector<int>& _pointIndices;
};

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

/// Builds one set of curves; the steps in the order in which they run.
class CurveBuilder {
public:
    CurveBuilder(const CurvesDesc& desc, const MessageSink& messages)
        : _desc(desc), _messages(messages), _mesh(std::make_shared<TriangleMesh>()) {
        _mesh->name = desc.name;
    }

    std::shared_ptr<TriangleMesh> build() {
        findCurves();
        findPrimvars();
        chooseDetail();
        for (const Curve& curve : _curves)
            addCurve(curve);
        for (TrianglePrimvar& primvar : _mesh->primvars)
            if (primvar.interpolation == Interpolation::Uniform) spreadUniform(primvar);
        setBounds(*_mesh);
        return _mesh;
    }

private:
    void findCurves();
    void findPrimvars();
    void chooseDetail();
    void addCurve(const Curve& curve);
    std::vector<CurveSample> samplesOf(const Curve& curve, uint32_t firstSegment, uint32_t segments) const;
    void addStrand(const Curve& curve, const std::vector<CurveSample>& samples);
    void addRibbon(const Curve& curve, const std::vector<CurveSample>& samples);
    void addTube(const Curve& curve, const std::vector<CurveSample>& samples);
    void addCap(const Curve& curve, const CurveSample& sample, uint32_t firstVertex,
                const glm::vec3& outwards, bool reversed);
    void addVertex(const Curve& curve, const CurveSample& sample, const glm::vec3& position,
                   const glm::vec3& normal);
    void addTriangle(const Curve& curve, const glm::uvec3& triangle);
    void spreadUniform(TrianglePrimvar& primvar) const;

    const glm::vec3& control(uint32_t i) const {
        return _desc.points[_desc.pointIndices.empty() ? i : size_t(_desc.pointIndices[i])];
    }
    bool exists(size_t i) const {
        if (_desc.pointIndices.empty()) return i < _desc.points.size();
        return i < _desc.pointIndices.size() && _desc.pointIndices[i] >= 0 &&
               size_t(_desc.pointIndices[i]) < _desc.points.size();
    }
    glm::vec3 pointAt(const Curve& curve, const std::array<float, 4>& weights,
                      const CurveSample& sample) const {
        glm::vec3 sum(0.f);
        for (size_t i = 0; i < 4; ++i)
            if (weights[i] != 0.f) sum += weights[i] * control(curve.first + sample.point[i]);
        return sum;
    }
    glm::vec3 position(const Curve& curve, const CurveSample& sample) const {
        return pointAt(curve, sample.weight, sample);
    }
    float radius(const Curve& curve, const CurveSample& sample) const {
        float width = _desc.width;
        if (_widths) _widths->evaluate(curve, sample, &width);
        return std::max(0.5f * width, 0.f);
    }
    uint32_t varyingOf(const Curve& curve) const {
        return varyingCount(_desc.basis, _desc.wrap, curve.count);
    }
    std::vector<glm::vec3> tangents(const Curve& curve, const std::vector<CurveSample>& samples) const;

    const CurvesDesc& _desc;
    const MessageSink& _messages;
    std::shared_ptr<TriangleMesh> _mesh;
    std::vector<Curve> _curves;
    uint32_t _varyingCount = 0;
    std::vector<CurvePrimvar> _primvars; ///< of the vertices, in the order of those of the mesh
    std::vector<size_t> _targets;        ///< where they are among the mesh's
    std::unique_ptr<CurvePrimvar> _widths, _normals;
    int _steps = 1; ///< of a segment
    uint32_t _sides = 8;
    bool _caps = true;
};

void CurveBuilder::findCurves() {
    size_t first = 0, tooFew = 0, beyond = 0, broken = 0;
    const std::set<int> hidden(_desc.hiddenCurves.begin(), _desc.hiddenCurves.end());
    for (size_t i = 0; i < _desc.vertexCounts.size(); ++i) {
        const int count = std::max(_desc.vertexCounts[i], 0);
        const Curve curve{uint32_t(i), uint32_t(first), uint32_t(count), _varyingCount};
        _varyingCount += varyingOf(curve);
        first += size_t(count);
        const auto all = [&](auto good) {
            for (uint32_t p = curve.first; p < curve.first + curve.count; ++p)
                if (!good(p)) return false;
            return true;
        };
        if (hidden.count(int(i))) continue;
        if (segmentCount(_desc.basis, _desc.wrap, curve.count) == 0)
            ++tooFew;
        else if (!all([&](uint32_t p) { return exists(p); }))
            ++beyond;
        else if (!all([&](uint32_t p) { return isFinite(control(p)); }))
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
    tell(broken, "control points that are NaN or infinite");
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
        segments += segmentCount(_desc.basis, _desc.wrap, curve.count);
    const int few = segments <= FewSegments ? 8 : 4; // steps
    _steps = _desc.basis == CurveBasis::Linear ? 1 : few << level;
    _sides = (segments <= FewSegments ? 16u : 8u) << std::min(level, 2);
    for (const uint32_t fewer : {8u, 4u, 3u})
        if (segments * size_t(_steps) * 2 * _sides > ManyTriangles && fewer < _sides) _sides = fewer;
    _caps = _sides > 4;
}

void CurveBuilder::addCurve(const Curve& curve) {
    const uint32_t segments = segmentCount(_desc.basis, _desc.wrap, curve.count);
    if (_desc.wrap != CurveWrap::Segments) return addStrand(curve, samplesOf(curve, 0, segments));
    for (uint32_t segment = 0; segment < segments; ++segment)
        addStrand(curve, samplesOf(curve, segment, 1));
}

std::vector<CurveSample> CurveBuilder::samplesOf(const Curve& curve, uint32_t firstSegment,
                                                 uint32_t segments) const {
    std::vector<CurveSample> samples;
    for (uint32_t segment = firstSegment; segment < firstSegment + segments; ++segment)
        for (int step = 0; step < _steps; ++step)
            samples.push_back(
                sampleCurve(_desc.basis, _desc.wrap, curve.count, segment, float(step) / float(_steps)));
    samples.push_back(sampleCurve(_desc.basis, _desc.wrap, curve.count, firstSegment + segments - 1, 1.f));
    return samples;
}

void CurveBuilder::addStrand(const Curve& curve, const std::vector<CurveSample>& samples) {
    _normals ? addRibbon(curve, samples) : addTube(curve, samples);
}

/// Directions of the curve; where it stands still, that of the chord, or of the sample before.
std::vector<glm::vec3> CurveBuilder::tangents(const Curve& curve,
                                              const std::vector<CurveSample>& samples) const {
    std::vector<glm::vec3> tangents(samples.size());
    glm::vec3 last(0.f);
    for (size_t i = 0; i < samples.size(); ++i) {
        glm::vec3 along(0.f);
        if (_desc.basis == CurveBasis::Linear) { // corners are mitred
            const size_t before = i > 0 ? i - 1 : i, after = i + 1 < samples.size() ? i + 1 : i;
            along = unitOrZero(position(curve, samples[i]) - position(curve, samples[before])) +
                    unitOrZero(position(curve, samples[after]) - position(curve, samples[i]));
        } else {
            along = pointAt(curve, samples[i].tangent, samples[i]);
            if (unitOrZero(along) == glm::vec3(0.f) && i + 1 < samples.size())
                along = position(curve, samples[i + 1]) - position(curve, samples[i]);
        }
        tangents[i] = unitOrZero(along);
        if (tangents[i] == glm::vec3(0.f)) tangents[i] = last;
        last = tangents[i];
    }
    for (size_t i = tangents.size() - 1; i > 0; --i)
        if (tangents[i - 1] == glm::vec3(0.f)) tangents[i - 1] = tangents[i];
    return tangents;
}

void CurveBuilder::addVertex(const Curve& curve, const CurveSample& sample, const glm::vec3& position,
                             const glm::vec3& normal) {
    _mesh->positions.push_back(position);
    _mesh->normals.push_back(normal);
    for (size_t i = 0; i < _primvars.size(); ++i) {
        float values[4];
        _primvars[i].evaluate(curve, sample, values);
        TrianglePrimvar& target = _mesh->primvars[_targets[i]];
        target.values.insert(target.values.end(), values, values + target.components);
    }
}

void CurveBuilder::addTriangle(const Curve& curve, const glm::uvec3& triangle) {
    _mesh->triangles.push_back(triangle);
    _mesh->triangleFace.push_back(curve.index);
}

void CurveBuilder::addRibbon(const Curve& curve, const std::vector<CurveSample>& samples) {
    _mesh->doubleSided = true;
    const std::vector<glm::vec3> along = tangents(curve, samples);
    const uint32_t first = uint32_t(_mesh->positions.size());
    for (size_t i = 0; i < samples.size(); ++i) {
        glm::vec3 facing(0.f);
        _normals->evaluate(curve, samples[i], &facing.x);
        facing = unitOrZero(facing);
        const glm::vec3 across = unitOrZero(glm::cross(facing, along[i])) * radius(curve, samples[i]);
        const glm::vec3 middle = position(curve, samples[i]);
        addVertex(curve, samples[i], middle - across, facing);
        addVertex(curve, samples[i], middle + across, facing);
    }
    for (uint32_t i = first; i + 3 < first + 2 * samples.size(); i += 2) {
        addTriangle(curve, {i, i + 1, i + 3});
        addTriangle(curve, {i, i + 3, i + 2});
    }
}

/// Carries a direction that is normal to the tangent from one sample to the next.
glm::vec3 carried(const glm::vec3& direction, const glm::vec3& from, const glm::vec3& to,
                  const glm::vec3& tangentFrom, const glm::vec3& tangentTo) {
    const auto reflected = [](const glm::vec3& v, const glm::vec3& plane) {
        const float squared = glm::dot(plane, plane);
        return squared > 0.f ? v - 2.f / squared * glm::dot(plane, v) * plane : v;
    };
    const glm::vec3 step = to - from;
    return reflected(reflected(direction, step), tangentTo - reflected(tangentFrom, step));
}

/// Any unit vector normal to `tangent`.
glm::vec3 anyNormal(const glm::vec3& tangent) {
    const glm::vec3 axis = std::abs(tangent.x) < 0.6f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return glm::normalize(glm::cross(tangent, axis));
}

void CurveBuilder::addTube(const Curve& curve, const std::vector<CurveSample>& samples) {
    const std::vector<glm::vec3> along = tangents(curve, samples);
    if (along[0] == glm::vec3(0.f)) return; // all points are one
    const uint32_t first = uint32_t(_mesh->positions.size());
    glm::vec3 side = anyNormal(along[0]);
    for (size_t i = 0; i < samples.size(); ++i) {
        const glm::vec3 middle = position(curve, samples[i]);
        if (i > 0) side = carried(side, position(curve, samples[i - 1]), middle, along[i - 1], along[i]);
        side = unitOrZero(side - glm::dot(side, along[i]) * along[i]); // what rounding has added up
        if (side == glm::vec3(0.f)) side = anyNormal(along[i]);
        const glm::vec3 up = glm::cross(along[i], side);
        const float r = radius(curve, samples[i]);
        for (uint32_t k = 0; k < _sides; ++k) {
            const float angle = glm::two_pi<float>() * float(k) / float(_sides);
            const glm::vec3 outwards = std::cos(angle) * side + std::sin(angle) * up;
            addVertex(curve, samples[i], middle + r * outwards, outwards);
        }
    }
    for (uint32_t ring = 0; ring + 1 < samples.size(); ++ring)
        for (uint32_t k = 0; k < _sides; ++k) {
            const uint32_t a = first + ring * _sides + k, b = first + ring * _sides + (k + 1) % _sides;
            addTriangle(curve, {a, b, b + _sides});
            addTriangle(curve, {a, b + _sides, a + _sides});
        }
    if (!_caps || _desc.wrap == CurveWrap::Periodic) return;
    addCap(curve, samples.front(), first, -along.front(), true);
    addCap(curve, samples.back(), first + uint32_t(samples.size() - 1) * _sides, along.back(), false);
}

void CurveBuilder::addCap(const Curve& curve, const CurveSample& sample, uint32_t firstVertex,
                          const glm::vec3& outwards, bool reversed) {
    const uint32_t first = uint32_t(_mesh->positions.size());
    for (uint32_t k = 0; k < _sides; ++k)
        addVertex(curve, sample, _mesh->positions[firstVertex + k], outwards);
    for (uint32_t k = 1; k + 1 < _sides; ++k)
        addTriangle(curve, reversed ? glm::uvec3(first, first + k + 1, first + k)
                                    : glm::uvec3(first, first + k, first + k + 1));
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

} // namespace
} // namespace geometry

std::shared_ptr<const TriangleMesh> buildCurves(const CurvesDesc& desc, const MessageSink& messages) {
    return geometry::orEmptyMesh(desc.name, messages,
                                 [&] { return geometry::CurveBuilder(desc, messages).build(); });
}

} // namespace hipr
