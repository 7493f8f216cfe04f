#include "renderer/geometry/displace.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "renderer/geometry/cage.h"
#include "renderer/geometry/finish.h"
#include "renderer/geometry/normals.h"

namespace hipr {

namespace {

using geometry::smoothNormals;
using geometry::unitOrZero;

/// A direction at right angles to n, near `wish` if that leads anywhere.
glm::vec3 perpendicular(const glm::vec3& n, const glm::vec3& wish) {
    const glm::vec3 along = unitOrZero(wish - n * glm::dot(n, wish));
    if (along != glm::vec3(0.f)) return along;
    const glm::vec3 axis = std::abs(n.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    return unitOrZero(axis - n * glm::dot(n, axis));
}

glm::vec2 stAt(const TrianglePrimvar& st, const glm::uvec3& triangle, size_t t, int corner) {
    const size_t element = st.interpolation == Interpolation::Vertex        ? triangle[corner]
                           : st.interpolation == Interpolation::FaceVarying ? 3 * t + size_t(corner)
                                                                            : 0;
    return glm::vec2(st.values[element * st.components], st.values[element * st.components + 1]);
}

/// The direction in which s grows over a triangle; zero where it does not.
glm::vec3 alongS(const TriangleMesh& mesh, const TrianglePrimvar& st, size_t t) {
    const glm::uvec3& v = mesh.triangles[t];
    const glm::vec3 e1 = mesh.positions[v.y] - mesh.positions[v.x],
                    e2 = mesh.positions[v.z] - mesh.positions[v.x];
    const glm::vec2 st0 = stAt(st, v, t, 0), d1 = stAt(st, v, t, 1) - st0, d2 = stAt(st, v, t, 2) - st0;
    const float area = d1.x * d2.y - d2.x * d1.y;
    return area > 0.f   ? unitOrZero(e1 * d2.y - e2 * d1.y)
           : area < 0.f ? unitOrZero(e2 * d1.y - e1 * d2.y)
                        : glm::vec3(0.f);
}

std::vector<glm::vec3> tangentsOf(const TriangleMesh& mesh, const std::vector<glm::vec3>& normals) {
    std::vector<glm::vec3> tangents(mesh.positions.size(), glm::vec3(0.f));
    for (const TrianglePrimvar& primvar : mesh.primvars) {
        const bool varies = primvar.interpolation == Interpolation::Vertex ||
                            primvar.interpolation == Interpolation::FaceVarying;
        if (primvar.name != "st" || primvar.components < 2 || !varies) continue;
        for (size_t t = 0; t < mesh.triangles.size(); ++t) {
            const glm::vec3 direction = alongS(mesh, primvar, t);
            for (int k = 0; k < 3; ++k)
                tangents[mesh.triangles[t][k]] += direction;
        }
    }
    for (size_t v = 0; v < tangents.size(); ++v)
        tangents[v] = perpendicular(normals[v], tangents[v]);
    return tangents;
}

/// What the corners of each vertex say, in the mean.
std::vector<glm::vec3> meanAtVertices(const TriangleMesh& mesh, const CornerDisplacement& at) {
    std::vector<glm::vec3> corners(3 * mesh.triangles.size());
    tbb::parallel_for(tbb::blocked_range<size_t>(0, mesh.triangles.size(), 1024), [&](const auto& range) {
        for (size_t t = range.begin(); t < range.end(); ++t)
            for (int k = 0; k < 3; ++k)
                corners[3 * t + size_t(k)] = at(uint32_t(t), k);
    });
    std::vector<glm::vec3> mean(mesh.positions.size(), glm::vec3(0.f));
    std::vector<uint32_t> count(mesh.positions.size());
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            mean[mesh.triangles[t][k]] += corners[3 * t + size_t(k)];
            ++count[mesh.triangles[t][k]];
        }
    }
    for (size_t v = 0; v < mean.size(); ++v)
        mean[v] /= float(std::max(count[v], 1u));
    return mean;
}

} // namespace

VertexFrames vertexFrames(const TriangleMesh& mesh) {
    VertexFrames frames;
    const bool own = mesh.normalInterpolation == Interpolation::Vertex && !mesh.normals.empty();
    frames.normals = own ? mesh.normals : smoothNormals(mesh.positions, mesh.triangles);
    frames.tangents = tangentsOf(mesh, frames.normals);
    return frames;
}

std::shared_ptr<const TriangleMesh> displace(const TriangleMesh& mesh, const VertexFrames& frames,
                                             const CornerDisplacement& at) {
    const std::vector<glm::vec3> moves = meanAtVertices(mesh, at);
    auto result = std::make_shared<TriangleMesh>(mesh);
    for (size_t v = 0; v < moves.size(); ++v) {
        const glm::vec3 &n = frames.normals[v], &t = frames.tangents[v], &move = moves[v];
        const glm::vec3 moved = mesh.positions[v] + t * move.x + glm::cross(n, t) * move.y + n * move.z;
        if (geometry::isFinite(moved)) result->positions[v] = moved;
    }
    geometry::setBounds(*result);
    if (mesh.normals.empty()) return result;
    // Where nothing moves, the normals stay what they are: those of the limit surface, or authored ones.
    const std::vector<glm::vec3> before = smoothNormals(mesh.positions, mesh.triangles);
    const std::vector<glm::vec3> after = smoothNormals(result->positions, mesh.triangles);
    for (size_t i = 0; i < mesh.normals.size(); ++i) {
        const size_t v =
            mesh.normalInterpolation == Interpolation::Vertex ? i : mesh.triangles[i / 3][int(i % 3)];
        const glm::vec3 turned = unitOrZero(mesh.normals[i] + (after[v] - before[v]));
        if (turned != glm::vec3(0.f)) result->normals[i] = turned;
    }
    return result;
}

} // namespace hipr
