#include "renderer/geometry/subdivide.h"

#include <algorithm>

#include <opensubdiv/far/primvarRefiner.h>

#include "renderer/geometry/normals.h"
#include "renderer/geometry/refiner.h"
#include "renderer/geometry/sharp_normals.h"

namespace hipr::geometry {

namespace {

/// Rows of `width` floats in the form OpenSubdiv's templates want: rows can be cleared and added to each
/// other. A narrower row takes the first columns of a wider one.
class Rows {
public:
    struct Row {
        float* data;
        uint32_t width;

        void Clear() { std::fill_n(data, width, 0.f); }
        void AddWithWeight(const Row& row, float weight) {
            for (uint32_t i = 0; i < width; ++i)
                data[i] += weight * row.data[i];
        }
    };

    Rows(size_t rows, uint32_t width) : _values(rows * width), _width(width) {}

    Row operator[](int row) const { return {const_cast<float*>(at(size_t(row))), _width}; }
    const float* at(size_t row) const { return _values.data() + row * _width; }
    float* at(size_t row) { return _values.data() + row * _width; }
    uint32_t width() const { return _width; }
    size_t size() const { return _width ? _values.size() / _width : 0; }

private:
    std::vector<float> _values;
    uint32_t _width;
};

/// Columns [first, first + components) of rows, as the values of a primvar.
void takeColumns(const Rows& rows, uint32_t first, PrimvarView& view) {
    view.repaired.clear();
    view.repaired.reserve(rows.size() * view.components);
    for (size_t r = 0; r < rows.size(); ++r) {
        const float* row = rows.at(r) + first;
        view.repaired.insert(view.repaired.end(), row, row + view.components);
    }
    view.values = view.repaired.data();
    view.indices = nullptr;
}

/// Runs refinement over one cage and fills a RefinedSurface.
class Subdivider {
public:
    Subdivider(const RefinerInput& input, const Far::TopologyRefiner& refiner, RefinedSurface& surface)
        : _input(input), _refiner(refiner), _primvarRefiner(refiner),
          _last(refiner.GetLevel(refiner.GetMaxLevel())), _surface(surface),
          _isSmooth(input.cage.scheme != SubdivisionScheme::Bilinear),
          _hasLimit(_isSmooth && limitMasksFit()) {}

    void run(const std::vector<PrimvarView>& primvars) {
        readTopology();
        refineVertexPrimvars(primvars);
        refineLinearPrimvars(primvars);
        int channel = 0;
        for (const PrimvarView& view : primvars) {
            if (view.interpolation == Interpolation::FaceVarying) {
                refineFaceVarying(view, channel++);
            } else if (view.interpolation != Interpolation::Vertex) {
                _surface.primvars.push_back({copyWithoutValues(view), {}});
            }
        }
        if (_isSmooth) splitNormalsAtCreases(_refiner, _surface);
    }

private:
    /// The surface outlives nothing of the description, so per-face and constant values keep pointing there.
    static PrimvarView copyWithoutValues(const PrimvarView& view) {
        return {view.name, view.interpolation, view.components, view.linear, view.values, view.indices, {}};
    }

    /// OpenSubdiv sizes its limit masks by edges, but around a non-manifold vertex there can be more faces
    /// than edges. Such a surface stays at its last level instead.
    bool limitMasksFit() const {
        const int room = _refiner.getLevel(_refiner.GetMaxLevel()).getMaxValence();
        for (int v = 0; v < _last.GetNumVertices(); ++v) {
            if (_last.GetVertexFaces(v).size() > room) return false;
        }
        return true;
    }

    void readTopology() {
        const int faces = _last.GetNumFaces(), levels = _refiner.GetMaxLevel();
        _surface.polygons.faceStart.reserve(size_t(faces) + 1);
        _surface.polygons.vertex.reserve(size_t(_last.GetNumFaceVertices()));
        _surface.cageFace.reserve(size_t(faces));
        for (int face = 0; face < faces; ++face) {
            for (const int v : _last.GetFaceVertices(face))
                _surface.polygons.vertex.push_back(uint32_t(v));
            _surface.polygons.faceStart.push_back(uint32_t(_surface.polygons.vertex.size()));
            int base = face;
            for (int level = levels; level > 0; --level)
                base = _refiner.GetLevel(level).GetFaceParentFace(base);
            _surface.cageFace.push_back(uint32_t(base));
        }
        if (!_refiner.HasHoles()) return;
        const Far::TopologyLevel& base = _refiner.GetLevel(0);
        for (const uint32_t face : _surface.cageFace)
            _surface.faceIsHole.push_back(base.IsFaceHole(int(face)));
    }

    /// Positions and smooth primvars share one pass, as their weights are the same.
    void refineVertexPrimvars(const std::vector<PrimvarView>& primvars) {
        Rows rows = gatherRows(primvars, false);
        for (int level = 1; level <= _refiner.GetMaxLevel(); ++level) {
            Rows refined(size_t(_refiner.GetLevel(level).GetNumVertices()), rows.width());
            _primvarRefiner.Interpolate(level, rows, refined);
            rows = std::move(refined);
        }
        if (_hasLimit) {
            rows = moveToLimit(rows);
        } else if (_isSmooth) {
            _surface.vertexNormals.assign(rows.size(), glm::vec3(0.f));
        }
        _surface.positions.reserve(rows.size());
        for (size_t v = 0; v < rows.size(); ++v) {
            _surface.positions.emplace_back(rows.at(v)[0], rows.at(v)[1], rows.at(v)[2]);
        }
        takePrimvars(rows, 3, primvars, false);
    }

    void refineLinearPrimvars(const std::vector<PrimvarView>& primvars) {
        Rows rows = gatherRows(primvars, true);
        if (rows.width() == 0) return;
        for (int level = 1; level <= _refiner.GetMaxLevel(); ++level) {
            Rows refined(size_t(_refiner.GetLevel(level).GetNumVertices()), rows.width());
            _primvarRefiner.InterpolateVarying(level, rows, refined);
            rows = std::move(refined);
        }
        takePrimvars(rows, 0, primvars, true);
    }

    static bool belongs(const PrimvarView& view, bool linear) {
        return view.interpolation == Interpolation::Vertex && view.linear == linear;
    }

    /// Per cage vertex: the position (unless linear), then the primvars that refine with it.
    Rows gatherRows(const std::vector<PrimvarView>& primvars, bool linear) const {
        uint32_t width = linear ? 0 : 3;
        for (const PrimvarView& view : primvars)
            width += belongs(view, linear) ? view.components : 0;
        Rows rows(_input.vertexSource.size(), width);
        for (size_t v = 0; v < _input.vertexSource.size() && width > 0; ++v) {
            const uint32_t source = _input.vertexSource[v];
            float* out = rows.at(v);
            if (!linear) out = std::copy_n(&_input.desc.points[source].x, 3, out);
            for (const PrimvarView& view : primvars) {
                if (belongs(view, linear)) out = std::copy_n(view.at(source), view.components, out);
            }
        }
        return rows;
    }

    void takePrimvars(const Rows& rows, uint32_t column, const std::vector<PrimvarView>& primvars,
                      bool linear) {
        for (const PrimvarView& view : primvars) {
            if (!belongs(view, linear)) continue;
            PrimvarView refined = copyWithoutValues(view);
            takeColumns(rows, column, refined);
            column += view.components;
            _surface.primvars.push_back({std::move(refined), {}});
        }
    }

    Rows moveToLimit(const Rows& rows) {
        Rows limit(rows.size(), rows.width()), tangent1(rows.size(), 3), tangent2(rows.size(), 3);
        _primvarRefiner.Limit(rows, limit, tangent1, tangent2);
        _surface.vertexNormals.reserve(rows.size());
        for (size_t v = 0; v < rows.size(); ++v) {
            const float *a = tangent1.at(v), *b = tangent2.at(v);
            // Unit tangents first: the product of two tiny ones would vanish.
            const glm::vec3 u = unitOrZero({a[0], a[1], a[2]}), w = unitOrZero({b[0], b[1], b[2]});
            _surface.vertexNormals.push_back(unitOrZero(glm::cross(u, w)));
        }
        return limit;
    }

    void refineFaceVarying(const PrimvarView& view, int channel) {
        const std::vector<uint32_t>& corners = _input.channels[size_t(channel)].representative;
        Rows rows(corners.size(), view.components);
        for (size_t value = 0; value < corners.size(); ++value) {
            std::copy_n(view.at(_input.cage.cornerSource[corners[value]]), view.components, rows.at(value));
        }
        for (int level = 1; level <= _refiner.GetMaxLevel(); ++level) {
            Rows refined(size_t(_refiner.GetLevel(level).GetNumFVarValues(channel)), view.components);
            _primvarRefiner.InterpolateFaceVarying(level, rows, refined, channel);
            rows = std::move(refined);
        }
        if (_hasLimit) {
            Rows limit(rows.size(), view.components);
            _primvarRefiner.LimitFaceVarying(rows, limit, channel);
            rows = std::move(limit);
        }
        RefinedPrimvar refined{copyWithoutValues(view), {}};
        takeColumns(rows, 0, refined.view);
        refined.cornerElement.reserve(_surface.polygons.vertex.size());
        for (int face = 0; face < _last.GetNumFaces(); ++face) {
            for (const int value : _last.GetFaceFVarValues(face, channel)) {
                refined.cornerElement.push_back(uint32_t(value));
            }
        }
        _surface.primvars.push_back(std::move(refined));
    }

    const RefinerInput& _input;
    const Far::TopologyRefiner& _refiner;
    const Far::PrimvarRefinerReal<float> _primvarRefiner;
    const Far::TopologyLevel& _last;
    RefinedSurface& _surface;
    const bool _isSmooth;
    const bool _hasLimit;
};

} // namespace

bool subdivide(const MeshDesc& desc, const Cage& cage, const std::vector<PrimvarView>& primvars,
               const MessageSink& messages, RefinedSurface& surface) {
    RefinerInput input(desc, cage);
    for (const PrimvarView& view : primvars) {
        if (view.interpolation == Interpolation::FaceVarying) {
            input.channels.push_back(connectFaceVarying(cage, view));
        }
    }
    const std::unique_ptr<Far::TopologyRefiner> refiner = makeRefiner(input);
    if (!refiner) {
        warn(messages, desc.name, "OpenSubdiv cannot refine this topology; the control cage is rendered");
        return false;
    }
    if (input.missingCreaseEdges) {
        warn(messages, desc.name,
             std::to_string(input.missingCreaseEdges) + " crease edges ignored: the mesh has no such edges");
    }
    Subdivider(input, *refiner, surface).run(primvars);
    return true;
}

} // namespace hipr::geometry
