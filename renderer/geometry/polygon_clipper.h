/// @file polygon_clipper.h
/// Triangulation of one polygon with more than four corners. Internal to renderer/geometry.
#pragma once

#include <vector>

#include <glm/glm.hpp>

namespace hipr::geometry {

/// Ear clipping (G. H. Meisters, "Polygons have ears", 1975) in the plane that shows the polygon largest.
/// Keeps its scratch memory between polygons. Non-planar polygons are judged by their projection; polygons
/// that cross themselves give some triangulation with the same corners. O(n^2) for n corners.
class PolygonClipper {
public:
    /// Writes n - 2 triangles of indices 0..n-1, wound like the polygon, to `out`.
    void triangulate(const std::vector<glm::vec3>& polygon, glm::uvec3* out);

private:
    /// How much an ear's triangle may touch the rest of the polygon.
    enum class Strictness { NothingInsideOrOnBorder, NothingInside, Anything };

    bool project(const std::vector<glm::vec3>& polygon);
    bool isConvex() const;
    double turn(uint32_t i) const;
    bool isEar(uint32_t i, Strictness strictness) const;
    void unlink(uint32_t i);
    void clipEars(glm::uvec3* out);

    std::vector<glm::dvec2> _points; ///< projected so that the polygon runs counter-clockwise
    std::vector<uint32_t> _next, _previous;
    std::vector<uint8_t> _isConvexCorner;
};

} // namespace hipr::geometry
