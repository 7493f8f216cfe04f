/// Small meshes and checks that the geometry tests share.
#pragma once

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/api/mesh.h"

namespace hipr::test {

/// Keeps every message as "subject: text".
struct Messages {
    std::vector<std::string> texts;

    MessageSink sink() {
        return [this](Severity, const std::string& subject, const std::string& text) {
            texts.push_back(subject + ": " + text);
        };
    }
};

/// Builds and expects no message at all.
inline std::shared_ptr<const TriangleMesh> buildQuietly(const MeshDesc& desc) {
    Messages messages;
    auto mesh = buildTriangleMesh(desc, messages.sink());
    EXPECT_EQ(messages.texts, std::vector<std::string>());
    return mesh;
}

/// One polygon through all points, in order.
inline MeshDesc polygon(std::vector<glm::vec3> points) {
    MeshDesc desc;
    desc.name = "/polygon";
    desc.faceVertexCounts = {int(points.size())};
    for (size_t i = 0; i < points.size(); ++i)
        desc.faceVertexIndices.push_back(int(i));
    desc.points = std::move(points);
    return desc;
}

/// The cube [-1, 1]^3 of six outward quads. Point i has x, y, z = -1 or 1 by its bits 0, 1, 2.
inline MeshDesc cube() {
    MeshDesc desc;
    desc.name = "/cube";
    for (int i = 0; i < 8; ++i)
        desc.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    desc.faceVertexCounts.assign(6, 4);
    desc.faceVertexIndices = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
    return desc;
}

/// A flat grid of n x n unit quads in the xy plane, facing +z. Point (x, y) has index y (n + 1) + x.
inline MeshDesc grid(int n) {
    MeshDesc desc;
    desc.name = "/grid";
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x)
            desc.points.emplace_back(x, y, 0);
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const int i = y * (n + 1) + x;
            desc.faceVertexCounts.push_back(4);
            desc.faceVertexIndices.insert(desc.faceVertexIndices.end(), {i, i + 1, i + n + 2, i + n + 1});
        }
    }
    return desc;
}

inline glm::dvec3 cornerOf(const TriangleMesh& mesh, size_t triangle, int corner) {
    return glm::dvec3(mesh.positions[mesh.triangles[triangle][corner]]);
}

/// Half the cross product of two edges: the triangle's area along its normal.
inline glm::dvec3 areaVector(const TriangleMesh& mesh, size_t triangle) {
    const glm::dvec3 a = cornerOf(mesh, triangle, 0);
    return 0.5 * glm::cross(cornerOf(mesh, triangle, 1) - a, cornerOf(mesh, triangle, 2) - a);
}

inline double area(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t)
        sum += glm::length(areaVector(mesh, t));
    return sum;
}

/// Signed volume by the divergence theorem: positive when a closed mesh's triangles face outward.
inline double volume(const TriangleMesh& mesh) {
    double sum = 0.0;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        sum += glm::dot(cornerOf(mesh, t, 0), areaVector(mesh, t)) / 3.0;
    }
    return sum;
}

/// Shading normal of a triangle's corner, whatever the interpolation.
inline glm::vec3 normalAt(const TriangleMesh& mesh, size_t triangle, int corner) {
    if (mesh.normalInterpolation == Interpolation::FaceVarying)
        return mesh.normals[3 * triangle + size_t(corner)];
    return mesh.normals[mesh.triangles[triangle][corner]];
}

inline const TrianglePrimvar* findPrimvar(const TriangleMesh& mesh, const std::string& name) {
    for (const TrianglePrimvar& primvar : mesh.primvars) {
        if (primvar.name == name) return &primvar;
    }
    return nullptr;
}

/// Index of the vertex nearest to a position.
inline size_t nearestVertex(const TriangleMesh& mesh, const glm::vec3& position) {
    size_t best = 0;
    for (size_t v = 1; v < mesh.positions.size(); ++v) {
        if (glm::distance(mesh.positions[v], position) < glm::distance(mesh.positions[best], position))
            best = v;
    }
    return best;
}

} // namespace hipr::test
