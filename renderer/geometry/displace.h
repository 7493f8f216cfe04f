/// @file displace.h
/// Vertices moved off the surface they are on.
#pragma once

#include <functional>

#include "renderer/api/mesh.h"

namespace hipr {

/// Directions at the vertices of a mesh, unit length, at right angles.
struct VertexFrames {
    std::vector<glm::vec3> normals;  ///< those of smooth shading, also for a mesh that is shaded as facets
    std::vector<glm::vec3> tangents; ///< along s of the primvar `st`; without one, any
};

VertexFrames vertexFrames(const TriangleMesh& mesh);

/// How far the surface is moved at a corner (0..2) of a triangle, along tangent, bitangent and normal of its
/// vertex.
using CornerDisplacement = std::function<glm::vec3(uint32_t triangle, int corner)>;

/// The mesh with every vertex moved by the mean of what the corners at it say, so that seams of materials and
/// texture coordinates do not open. Shading normals turn as the smooth normals of the triangles do; facets
/// stay facets. `at` is asked by several threads at once. What is not finite moves nothing.
std::shared_ptr<const TriangleMesh> displace(const TriangleMesh& mesh, const VertexFrames& frames,
                                             const CornerDisplacement& at);

} // namespace hipr
