/// @file normals.h
/// Shading normals. Internal to renderer/geometry.
#pragma once

#include "renderer/geometry/triangulate.h"

namespace hipr::geometry {

/// Unit vector, or zero when `v` has no direction. Scaled first, so that tiny and huge vectors keep theirs.
glm::vec3 unitOrZero(const glm::vec3& v);

/// Unit normal of a triangle, or zero when it has no area.
glm::vec3 facetNormal(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Angle between b - a and c - a in radians; 0 when an edge has no length.
float cornerAngle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

/// Vertex normals as the angle-weighted mean of the facets around (G. Thuermer and C. Wuethrich, "Computing
/// vertex normals from polygonal facets", 1998). Unit length; vertices whose facets cancel take one of them.
std::vector<glm::vec3> smoothNormals(const std::vector<glm::vec3>& positions,
                                     const std::vector<glm::uvec3>& triangles);

/// Sets mesh.normals from an authored primvar. `cornerSource` is the authored corner of each soup corner.
/// Where an authored normal has no direction the smooth (Vertex) or facet normal (others) takes its place,
/// and one message says so.
void setAuthoredNormals(const PrimvarView& normals, const Triangulation& triangulation,
                        const std::vector<uint32_t>& cornerSource, const MessageSink& messages,
                        TriangleMesh& mesh);

} // namespace hipr::geometry
