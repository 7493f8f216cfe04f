#include "renderer/geometry/sharp_normals.h"

#include <algorithm>
#include <numeric>

#include "renderer/geometry/normals.h"

namespace hipr::geometry {

namespace {

/// The faces around one vertex of the last level, in groups that no sharp edge divides.
class FaceFan {
public:
    FaceFan(const Far::TopologyLevel& level, RefinedSurface& surface) : _level(level), _surface(surface) {}

    void split(int vertex) {
        if (!needsSplit(vertex)) return;
        if (_surface.cornerNormals.empty()) startCornerNormals();
        group(vertex);
        const Far::ConstIndexArray faces = _level.GetVertexFaces(vertex);
        const Far::ConstLocalIndexArray places = _level.GetVertexFaceLocalIndices(vertex);
        _sum.assign(size_t(faces.size()), glm::vec3(0.f));
        for (int i = 0; i < faces.size(); ++i)
            _sum[size_t(_group[i])] += weightedNormal(faces[i], places[i]);
        for (int i = 0; i < faces.size(); ++i) {
            const uint32_t corner = _surface.polygons.faceStart[size_t(faces[i])] + places[i];
            const glm::vec3 normal = unitOrZero(_sum[size_t(_group[i])]);
            if (normal != glm::vec3(0.f)) _surface.cornerNormals[corner] = normal;
        }
    }

private:
    bool isSharp(int edge) const {
        return _level.GetEdgeFaces(edge).size() > 1 &&
               (_level.GetEdgeSharpness(edge) > 0.f || _level.IsEdgeInfSharp(edge));
    }

    /// Inner sharp corners too: their tangents come from one face only.
    bool needsSplit(int vertex) const {
        if (_level.IsVertexInfSharp(vertex) && !_level.IsVertexBoundary(vertex)) return true;
        const Far::ConstIndexArray edges = _level.GetVertexEdges(vertex);
        return std::any_of(edges.begin(), edges.end(), [&](int edge) { return isSharp(edge); });
    }

    void startCornerNormals() {
        _surface.cornerNormals.reserve(_surface.polygons.vertex.size());
        for (const uint32_t v : _surface.polygons.vertex) {
            _surface.cornerNormals.push_back(_surface.vertexNormals[v]);
        }
    }

    /// _group[i] becomes the smallest place of a face that face i reaches without crossing a sharp edge.
    void group(int vertex) {
        const Far::ConstIndexArray faces = _level.GetVertexFaces(vertex),
                                   edges = _level.GetVertexEdges(vertex);
        _group.resize(size_t(faces.size()));
        std::iota(_group.begin(), _group.end(), 0);
        for (const int edge : edges) {
            const Far::ConstIndexArray sides = _level.GetEdgeFaces(edge);
            if (isSharp(edge) || sides.size() != 2) continue;
            const int a = faces.FindIndex(sides[0]), b = faces.FindIndex(sides[1]);
            if (a >= 0 && b >= 0) merge(_group[size_t(a)], _group[size_t(b)]);
        }
    }

    void merge(int a, int b) { std::replace(_group.begin(), _group.end(), std::max(a, b), std::min(a, b)); }

    glm::vec3 weightedNormal(int face, int place) const {
        const uint32_t first = _surface.polygons.faceStart[size_t(face)];
        const int size = int(_surface.polygons.faceSize(size_t(face)));
        const auto position = [&](int i) {
            return _surface.positions[_surface.polygons.vertex[first + uint32_t(i % size)]];
        };
        const glm::vec3 here = position(place), next = position(place + 1),
                        previous = position(place + size - 1);
        return facetNormal(here, next, previous) * cornerAngle(here, next, previous);
    }

    const Far::TopologyLevel& _level;
    RefinedSurface& _surface;
    std::vector<int> _group;
    std::vector<glm::vec3> _sum;
};

} // namespace

void splitNormalsAtCreases(const Far::TopologyRefiner& refiner, RefinedSurface& surface) {
    const Far::TopologyLevel& level = refiner.GetLevel(refiner.GetMaxLevel());
    FaceFan fan(level, surface);
    for (int vertex = 0; vertex < level.GetNumVertices(); ++vertex)
        fan.split(vertex);
}

} // namespace hipr::geometry
