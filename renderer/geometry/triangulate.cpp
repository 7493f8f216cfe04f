#include "renderer/geometry/triangulate.h"

#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/geometry/polygon_clipper.h"

namespace hipr::geometry {

namespace {

constexpr size_t FacesPerTask = 4096;

/// True when a quad must be cut from its second to its fourth corner, because it is concave at one of those
/// two: cut the other way, one half would face backwards.
bool cutsSecondDiagonal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d) {
    const glm::vec3 normal = glm::cross(c - a, d - b);
    const auto faces = [&](const glm::vec3& p, const glm::vec3& q, const glm::vec3& r) {
        return glm::dot(glm::cross(q - p, r - p), normal) > 0.f;
    };
    const bool firstIsGood = faces(a, b, c) && faces(a, c, d);
    return !firstIsGood && faces(a, b, d) && faces(b, c, d);
}

/// Triangulates faces one at a time; one per task, for its scratch memory.
class FaceCutter {
public:
    FaceCutter(const std::vector<glm::vec3>& points, const Polygons& polygons)
        : _points(points), _polygons(polygons) {}

    /// Writes size - 2 triangles to `out`.
    void cut(size_t face, glm::uvec3* out) {
        const uint32_t first = _polygons.faceStart[face], size = _polygons.faceSize(face);
        if (size == 3) {
            *out = {first, first + 1, first + 2};
        } else if (size == 4) {
            const uint32_t start =
                cutsSecondDiagonal(point(first), point(first + 1), point(first + 2), point(first + 3)) ? 1
                                                                                                       : 0;
            out[0] = first + glm::uvec3(start, start + 1, start + 2);
            out[1] = first + glm::uvec3(start, start + 2, (start + 3) % 4);
        } else {
            _polygon.resize(size);
            for (uint32_t i = 0; i < size; ++i)
                _polygon[i] = point(first + i);
            _clipper.triangulate(_polygon, out);
            for (uint32_t i = 0; i + 2 < size; ++i)
                out[i] += first;
        }
    }

private:
    const glm::vec3& point(uint32_t corner) const { return _points[_polygons.vertex[corner]]; }

    const std::vector<glm::vec3>& _points;
    const Polygons& _polygons;
    PolygonClipper _clipper;
    std::vector<glm::vec3> _polygon;
};

bool repeatsVertex(const Polygons& polygons, const glm::uvec3& t) {
    const uint32_t a = polygons.vertex[t.x], b = polygons.vertex[t.y], c = polygons.vertex[t.z];
    return a == b || b == c || c == a;
}

/// Polygons that visit a vertex twice can leave triangles without an area; they are rare.
void removeRepeated(const Polygons& polygons, Triangulation& triangulation) {
    size_t kept = 0;
    for (size_t t = 0; t < triangulation.corners.size(); ++t) {
        if (repeatsVertex(polygons, triangulation.corners[t])) continue;
        triangulation.corners[kept] = triangulation.corners[t];
        triangulation.face[kept++] = triangulation.face[t];
    }
    triangulation.corners.resize(kept);
    triangulation.face.resize(kept);
}

} // namespace

Triangulation triangulate(const std::vector<glm::vec3>& points, const Polygons& polygons,
                          const std::vector<uint8_t>& skipFace) {
    const size_t faces = polygons.faceCount();
    std::vector<uint32_t> start(faces + 1, 0);
    for (size_t face = 0; face < faces; ++face) {
        const bool skip = !skipFace.empty() && skipFace[face];
        start[face + 1] = start[face] + (skip ? 0 : polygons.faceSize(face) - 2);
    }
    Triangulation result;
    result.corners.resize(start[faces]);
    result.face.resize(start[faces]);
    std::atomic<bool> repeated{false};
    tbb::parallel_for(tbb::blocked_range<size_t>(0, faces, FacesPerTask), [&](const auto& range) {
        FaceCutter cutter(points, polygons);
        for (size_t face = range.begin(); face < range.end(); ++face) {
            if (start[face] == start[face + 1]) continue;
            cutter.cut(face, result.corners.data() + start[face]);
            for (uint32_t t = start[face]; t < start[face + 1]; ++t) {
                result.face[t] = uint32_t(face);
                if (repeatsVertex(polygons, result.corners[t])) repeated = true;
            }
        }
    });
    if (repeated) removeRepeated(polygons, result);
    return result;
}

} // namespace hipr::geometry
