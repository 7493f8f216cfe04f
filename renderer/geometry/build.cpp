#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include "renderer/geometry/cage.h"
#include "renderer/geometry/finish.h"
#include "renderer/geometry/normals.h"
#include "renderer/geometry/primvars.h"
#include "renderer/geometry/subdivide.h"
#include "renderer/geometry/triangulate.h"

namespace hipr {

namespace geometry {
namespace {

constexpr const char* NormalsName = "normals";

struct Bounds {
    glm::vec3 min{std::numeric_limits<float>::max()}, max{std::numeric_limits<float>::lowest()};

    void add(const Bounds& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
};

/// Points for TriangleMesh::positions: the authored ones, with those that no face may use made harmless.
std::vector<glm::vec3> finitePoints(const std::vector<glm::vec3>& points) {
    std::vector<glm::vec3> result = points;
    for (glm::vec3& point : result) {
        if (!isFinite(point)) point = glm::vec3(0.f);
    }
    return result;
}

bool isFaceted(const MeshDesc& desc) {
    return desc.flatNormals || desc.scheme == SubdivisionScheme::None ||
           desc.scheme == SubdivisionScheme::Bilinear;
}

/// Builds one mesh; the steps in the order in which they run.
class Builder {
public:
    Builder(const MeshDesc& desc, const MessageSink& messages)
        : _desc(desc), _messages(messages), _mesh(std::make_shared<TriangleMesh>()) {
        _mesh->name = desc.name;
        _mesh->doubleSided = desc.doubleSided;
    }

    std::shared_ptr<TriangleMesh> build() {
        _cage = validateFaces(_desc, _messages);
        validateSubdivision(_desc, _messages, _cage);
        if (_cage.polygons.faceCount() == 0) return _mesh;
        _primvars = validatePrimvars(_desc, _messages);
        takeNormals();
        RefinedSurface surface;
        if (_cage.refineLevel > 0 && subdivide(_desc, _cage, _primvars, _messages, surface)) {
            buildRefined(surface);
        } else {
            buildCage();
        }
        setBounds(*_mesh);
        return _mesh;
    }

private:
    /// `normals` shade polygonal meshes and nothing else, so they leave the list of primvars.
    void takeNormals() {
        const auto isNormals = [](const PrimvarView& view) { return view.name == NormalsName; };
        const auto found = std::find_if(_primvars.begin(), _primvars.end(), isNormals);
        if (found == _primvars.end()) return;
        if (_desc.scheme == SubdivisionScheme::None && !_desc.flatNormals) {
            if (found->components == 3) {
                _normals = std::make_unique<PrimvarView>(std::move(*found));
            } else {
                warn(_messages, _desc.name, "normals dropped: they need 3 components");
            }
        }
        _primvars.erase(found);
    }

    /// Triangles of `polygons`, and for each its authored face and slot.
    Triangulation setTriangles(const Polygons& polygons, const std::vector<uint8_t>& skipFace,
                               const std::vector<uint32_t>* cageFace) {
        Triangulation triangulation = triangulate(_mesh->positions, polygons, skipFace);
        const size_t count = triangulation.corners.size();
        _mesh->triangles.resize(count);
        _mesh->triangleFace.resize(count);
        if (!_cage.faceSlot.empty()) _mesh->triangleSlot.resize(count);
        for (size_t t = 0; t < count; ++t) {
            const glm::uvec3& c = triangulation.corners[t];
            _mesh->triangles[t] = {polygons.vertex[c.x], polygons.vertex[c.y], polygons.vertex[c.z]};
            const uint32_t face = cageFace ? (*cageFace)[triangulation.face[t]] : triangulation.face[t];
            _mesh->triangleFace[t] = _cage.faceSource[face];
            if (!_cage.faceSlot.empty()) _mesh->triangleSlot[t] = _cage.faceSlot[face];
        }
        return triangulation;
    }

    void buildCage() {
        _mesh->positions = finitePoints(_desc.points);
        const Triangulation triangulation = setTriangles(_cage.polygons, _cage.faceIsHole, nullptr);
        for (const PrimvarView& view : _primvars)
            addPrimvar(view, triangulation, _cage.cornerSource);
        if (_normals) {
            setAuthoredNormals(*_normals, triangulation, _cage.cornerSource, _messages, *_mesh);
        } else if (!isFaceted(_desc)) {
            _mesh->normals = smoothNormals(_mesh->positions, _mesh->triangles);
        }
    }

    void buildRefined(RefinedSurface& surface) {
        _mesh->positions = std::move(surface.positions);
        const Triangulation triangulation =
            setTriangles(surface.polygons, surface.faceIsHole, &surface.cageFace);
        for (const RefinedPrimvar& primvar : surface.primvars) {
            addPrimvar(primvar.view, triangulation, primvar.cornerElement);
        }
        if (!isFaceted(_desc)) setLimitNormals(surface, triangulation);
    }

    void addPrimvar(const PrimvarView& view, const Triangulation& triangulation,
                    const std::vector<uint32_t>& cornerElement) {
        _mesh->primvars.push_back(
            expandPrimvar(view, triangulation, cornerElement, _mesh->triangleFace, _mesh->positions.size()));
    }

    /// Limit normals; where the limit surface has none (a collapsed face), smooth ones.
    void setLimitNormals(RefinedSurface& surface, const Triangulation& triangulation) {
        const glm::vec3 none(0.f);
        const bool perCorner = !surface.cornerNormals.empty();
        if (perCorner) {
            _mesh->normalInterpolation = Interpolation::FaceVarying;
            _mesh->normals.reserve(triangulation.corners.size() * 3);
            for (const glm::uvec3& corners : triangulation.corners) {
                for (int k = 0; k < 3; ++k)
                    _mesh->normals.push_back(surface.cornerNormals[corners[k]]);
            }
        } else {
            _mesh->normals = std::move(surface.vertexNormals);
        }
        if (std::find(_mesh->normals.begin(), _mesh->normals.end(), none) == _mesh->normals.end()) return;
        const std::vector<glm::vec3> smooth = smoothNormals(_mesh->positions, _mesh->triangles);
        for (size_t i = 0; i < _mesh->normals.size(); ++i) {
            const size_t vertex = perCorner ? _mesh->triangles[i / 3][int(i % 3)] : i;
            if (_mesh->normals[i] == none) _mesh->normals[i] = smooth[vertex];
        }
    }

    const MeshDesc& _desc;
    const MessageSink& _messages;
    std::shared_ptr<TriangleMesh> _mesh;
    Cage _cage;
    std::vector<PrimvarView> _primvars;
    std::unique_ptr<PrimvarView> _normals;
};

/// The faces of a description in which nothing has to be dropped.
Polygons allFaces(const MeshDesc& desc) {
    Polygons polygons;
    for (const int size : desc.faceVertexCounts) {
        const uint32_t first = polygons.faceStart.back(), count = uint32_t(size);
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t corner = first + (desc.leftHanded && i > 0 ? count - i : i);
            polygons.vertex.push_back(uint32_t(desc.faceVertexIndices[corner]));
        }
        polygons.faceStart.push_back(first + count);
    }
    return polygons;
}

/// Whether the polygons, which are those of `old`, are cut as they were: that depends on where their corners
/// are.
bool cutAlike(const TriangleMesh& old, const MeshDesc& desc) {
    const std::vector<int>& counts = desc.faceVertexCounts;
    if (std::all_of(counts.begin(), counts.end(), [](int count) { return count == 3; })) return true;
    const Polygons polygons = allFaces(desc);
    const std::vector<glm::uvec3> corners = triangulate(desc.points, polygons, {}).corners;
    return std::equal(corners.begin(), corners.end(), old.triangles.begin(), old.triangles.end(),
                      [&](const glm::uvec3& c, const glm::uvec3& triangle) {
                          return glm::uvec3(polygons.vertex[c.x], polygons.vertex[c.y],
                                            polygons.vertex[c.z]) == triangle;
                      });
}

/// Whether the triangles of `old` are those of `desc`: nothing was dropped then, and nothing will be now.
bool keepsTriangles(const TriangleMesh& old, const MeshDesc& desc) {
    const bool authoredNormals = std::any_of(desc.primvars.begin(), desc.primvars.end(),
                                             [](const Primvar& p) { return p.name == NormalsName; });
    if (desc.scheme != SubdivisionScheme::None || authoredNormals || !desc.holeFaces.empty()) return false;
    if (old.positions.size() != desc.points.size()) return false;
    size_t triangles = 0;
    for (const int count : desc.faceVertexCounts)
        triangles += size_t(std::max(count, 2)) - 2;
    return old.triangles.size() == triangles &&
           std::all_of(desc.points.begin(), desc.points.end(), isFinite) && cutAlike(old, desc);
}

} // namespace

void setBounds(TriangleMesh& mesh) {
    if (mesh.empty()) return;
    const auto addRange = [&](const auto& range, Bounds bounds) {
        for (size_t t = range.begin(); t < range.end(); ++t) {
            for (int k = 0; k < (mesh.segments.empty() ? 3 : 2); ++k) {
                const size_t vertex =
                    mesh.segments.empty() ? mesh.triangles[t][k] : mesh.segments[t] + size_t(k);
                const glm::vec3& p = mesh.positions[vertex];
                const glm::vec3 half(mesh.segments.empty() ? 0.f : mesh.radii[vertex]);
                bounds.add({p - half, p + half});
            }
        }
        return bounds;
    };
    const auto join = [](Bounds a, const Bounds& b) {
        a.add(b);
        return a;
    };
    const tbb::blocked_range<size_t> all(0, mesh.primitiveCount(), 16384);
    const Bounds bounds = tbb::parallel_reduce(all, Bounds{}, addRange, join);
    mesh.boundsMin = bounds.min;
    mesh.boundsMax = bounds.max;
}

} // namespace geometry

std::shared_ptr<const TriangleMesh> buildTriangleMesh(const MeshDesc& desc, const MessageSink& messages) {
    return geometry::orEmptyMesh(desc.name, messages,
                                 [&] { return geometry::Builder(desc, messages).build(); });
}

std::shared_ptr<const TriangleMesh> updatePoints(const TriangleMesh& old, const MeshDesc& desc,
                                                 const MessageSink& messages) {
    if (!geometry::keepsTriangles(old, desc)) return buildTriangleMesh(desc, messages);
    return geometry::orEmptyMesh(desc.name, messages, [&] {
        auto mesh = std::make_shared<TriangleMesh>(old);
        mesh->positions = desc.points;
        geometry::setBounds(*mesh);
        return mesh;
    });
}

} // namespace hipr
