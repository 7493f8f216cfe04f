/// @file triangulate.h
/// Polygons to triangles. Internal to renderer/geometry.
#pragma once

#include "renderer/geometry/cage.h"

namespace hipr::geometry {

/// Triangles that cover the faces of a Polygons, in face order.
struct Triangulation {
    std::vector<glm::uvec3> corners; ///< indices into Polygons::vertex; winding of the polygon
    std::vector<uint32_t> face;      ///< face in the Polygons of each triangle
};

/// Cuts every face whose `skipFace` byte is not set (empty: none) into size - 2 triangles. Convex faces
/// become fans from their first corner, quads are cut along the diagonal that keeps both halves facing the
/// same way, other concave polygons are clipped ear by ear. Triangles with a repeated vertex are left out.
Triangulation triangulate(const std::vector<glm::vec3>& points, const Polygons& polygons,
                          const std::vector<uint8_t>& skipFace);

} // namespace hipr::geometry
