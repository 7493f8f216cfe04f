#include "renderer/geometry/normals.h"

#include <atomic>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace hipr::geometry {

namespace {

constexpr size_t TrianglesPerTask = 8192;

bool isZero(const glm::vec3& v) {
    return v == glm::vec3(0.f);
}

const float* valueAt(const PrimvarView& normals, size_t triangle, size_t authoredCorner,
                     const TriangleMesh& mesh) {
    switch (normals.interpolation) {
    case Interpolation::Uniform:
        return normals.at(mesh.triangleFace[triangle]);
    case Interpolation::FaceVarying:
        return normals.at(authoredCorner);
    default:
        return normals.at(0);
    }
}

size_t setVertexNormals(const PrimvarView& normals, TriangleMesh& mesh) {
    mesh.normalInterpolation = Interpolation::Vertex;
    mesh.normals.resize(mesh.positions.size());
    size_t broken = 0;
    for (size_t v = 0; v < mesh.normals.size(); ++v) {
        const float* n = normals.at(v);
        mesh.normals[v] = unitOrZero({n[0], n[1], n[2]});
        broken += isZero(mesh.normals[v]);
    }
    if (broken == 0) return 0;
    const std::vector<glm::vec3> smooth = smoothNormals(mesh.positions, mesh.triangles);
    for (size_t v = 0; v < mesh.normals.size(); ++v) {
        if (isZero(mesh.normals[v])) mesh.normals[v] = smooth[v];
    }
    return broken;
}

size_t setCornerNormals(const PrimvarView& normals, const Triangulation& triangulation,
                        const std::vector<uint32_t>& cornerSource, TriangleMesh& mesh) {
    mesh.normalInterpolation = Interpolation::FaceVarying;
    mesh.normals.resize(mesh.triangles.size() * 3);
    std::atomic<size_t> broken{0};
    const tbb::blocked_range<size_t> all(0, mesh.triangles.size(), TrianglesPerTask);
    tbb::parallel_for(all, [&](const auto& range) {
        for (size_t t = range.begin(); t < range.end(); ++t) {
            for (int k = 0; k < 3; ++k) {
                const float* n = valueAt(normals, t, cornerSource[triangulation.corners[t][k]], mesh);
                glm::vec3& normal = mesh.normals[3 * t + size_t(k)];
                normal = unitOrZero({n[0], n[1], n[2]});
                if (!isZero(normal)) continue;
                ++broken;
                const glm::uvec3 v = mesh.triangles[t];
                normal = facetNormal(mesh.positions[v.x], mesh.positions[v.y], mesh.positions[v.z]);
                if (isZero(normal)) normal = glm::vec3(0.f, 0.f, 1.f);
            }
        }
    });
    return broken;
}

} // namespace

glm::vec3 unitOrZero(const glm::vec3& v) {
    const float size = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(size > 0.f) || !std::isfinite(size)) return glm::vec3(0.f);
    return glm::normalize(v / size);
}

glm::vec3 facetNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    return unitOrZero(glm::cross(b - a, c - a));
}

float cornerAngle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const glm::vec3 u = unitOrZero(b - a), v = unitOrZero(c - a);
    // atan2 stays accurate where acos of a rounded cosine does not: at thin corners.
    return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

std::vector<glm::vec3> smoothNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<glm::uvec3>& triangles) {
    // Weighted facet normals per corner in parallel, then summed in triangle order: the same result every
    // time.
    std::vector<glm::vec3> cornerNormals(triangles.size() * 3);
    const tbb::blocked_range<size_t> all(0, triangles.size(), TrianglesPerTask);
    tbb::parallel_for(all, [&](const auto& range) {
        for (size_t t = range.begin(); t < range.end(); ++t) {
            const glm::vec3 p[3] = {positions[triangles[t].x], positions[triangles[t].y],
                                    positions[triangles[t].z]};
            const glm::vec3 facet = facetNormal(p[0], p[1], p[2]);
            for (int k = 0; k < 3; ++k) {
                cornerNormals[3 * t + size_t(k)] = facet * cornerAngle(p[k], p[(k + 1) % 3], p[(k + 2) % 3]);
            }
        }
    });
    std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.f));
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k)
            normals[triangles[t][k]] += cornerNormals[3 * t + size_t(k)];
    }
    for (glm::vec3& normal : normals)
        normal = unitOrZero(normal);
    for (size_t t = 0; t < triangles.size(); ++t) {
        for (int k = 0; k < 3; ++k) {
            glm::vec3& normal = normals[triangles[t][k]];
            if (isZero(normal)) normal = unitOrZero(cornerNormals[3 * t + size_t(k)]);
        }
    }
    for (glm::vec3& normal : normals) {
        if (isZero(normal)) normal = glm::vec3(0.f, 0.f, 1.f); // no triangle with an area uses it
    }
    return normals;
}

void setAuthoredNormals(const PrimvarView& normals, const Triangulation& triangulation,
                        const std::vector<uint32_t>& cornerSource, const MessageSink& messages,
                        TriangleMesh& mesh) {
    const size_t broken = normals.interpolation == Interpolation::Vertex
                              ? setVertexNormals(normals, mesh)
                              : setCornerNormals(normals, triangulation, cornerSource, mesh);
    if (broken == 0) return;
    warn(messages, mesh.name,
         std::to_string(broken) + " of " + std::to_string(mesh.normals.size()) +
             " authored normals have no length; computed ones take their place");
}

} // namespace hipr::geometry
