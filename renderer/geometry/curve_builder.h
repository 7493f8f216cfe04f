/// @file curve_builder.h
/// A set of curves on its way to triangles or round segments. Internal to renderer/geometry.
#pragma once

#include <algorithm>

#include "renderer/api/curves.h"
#include "renderer/geometry/cage.h"
#include "renderer/geometry/curve_basis.h"

namespace hipr::geometry {

/// Of points and radii; its square is finite.
constexpr float LargestCoordinate = 1e18f;

/// A curve that can be built.
struct Curve {
    uint32_t index;        ///< authored
    uint32_t first, count; ///< control points
    uint32_t firstVarying; ///< of its varying values
    uint32_t firstSegment; ///< of all segments of authored curves
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

/// Builds one set of curves; the steps in the order in which they run.
class CurveBuilder {
public:
    CurveBuilder(const CurvesDesc& desc, const MessageSink& messages)
        : _desc(desc), _messages(messages), _mesh(std::make_shared<TriangleMesh>()) {
        _mesh->name = desc.name;
    }

    std::shared_ptr<TriangleMesh> build();
    /// The form that build() would choose.
    CurveForm form();

private:
    void findCurves();
    void findPrimvars();
    CurveForm chooseForm() const;
    bool thin() const;
    int stepsOf(const Curve& curve, uint32_t segment) const;
    void chooseDetail();
    void addCurve(const Curve& curve);
    std::vector<CurveSample> samplesOf(const Curve& curve, uint32_t firstSegment, uint32_t segments) const;
    void addRibbon(const Curve& curve, const std::vector<CurveSample>& samples);
    void addTube(const Curve& curve, const std::vector<CurveSample>& samples);
    void addCap(const Curve& curve, const CurveSample& sample, uint32_t firstVertex,
                const glm::vec3& outwards, bool reversed);
    void addVertex(const Curve& curve, const CurveSample& sample, const glm::vec3& position,
                   const glm::vec3& normal);
    void addTriangle(const Curve& curve, const glm::uvec3& triangle);
    void addSegments(const Curve& curve, const std::vector<CurveSample>& samples);
    void addSegmentVertex(const Curve& curve, const CurveSample& sample, const glm::vec3& position);
    void addPrimvars(const Curve& curve, const CurveSample& sample);
    void spreadUniform(TrianglePrimvar& primvar) const;

    const glm::vec3& control(uint32_t i) const {
        return _desc.points[_desc.pointIndices.empty() ? i : size_t(_desc.pointIndices[i])];
    }
    /// Of a control point that is there: whether its index names a point.
    bool exists(size_t i) const {
        return _desc.pointIndices.empty() ||
               (_desc.pointIndices[i] >= 0 && size_t(_desc.pointIndices[i]) < _desc.points.size());
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
        return std::min(std::max(0.f, 0.5f * width), LargestCoordinate); // in this order 0 for NaN
    }
    CurveSample sampleAt(const Curve& curve, uint32_t segment, float t) const {
        return sampleCurve(_desc.basis, _desc.wrap, curve.count, segment, t);
    }
    uint32_t segmentsOf(const Curve& curve) const {
        return segmentCount(_desc.basis, _desc.wrap, curve.count);
    }
    uint32_t varyingOf(const Curve& curve) const {
        return varyingCount(_desc.basis, _desc.wrap, curve.count);
    }
    std::vector<glm::vec3> tangents(const Curve& curve, const std::vector<CurveSample>& samples) const;

    const CurvesDesc& _desc;
    const MessageSink& _messages;
    std::shared_ptr<TriangleMesh> _mesh;
    std::vector<Curve> _curves;
    uint32_t _varyingCount = 0, _segmentCount = 0; ///< of all authored curves
    std::vector<CurvePrimvar> _primvars;           ///< of the vertices, in the order of those of the mesh
    std::vector<size_t> _targets;                  ///< where they are among the mesh's
    std::unique_ptr<CurvePrimvar> _widths, _normals;
    CurveForm _form;
    int _steps = 1; ///< of a segment of tubes and ribbons
    uint32_t _sides = 16;
    bool _caps = true;
};

} // namespace hipr::geometry
