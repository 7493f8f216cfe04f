#include "renderer/geometry/polygon_clipper.h"

#include <algorithm>

namespace hipr::geometry {

namespace {

/// Twice the signed area of a triangle; positive when counter-clockwise.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

} // namespace

void PolygonClipper::triangulate(const std::vector<glm::vec3>& polygon, glm::uvec3* out) {
    const uint32_t n = uint32_t(polygon.size());
    if (!project(polygon) || isConvex()) {
        for (uint32_t i = 0; i + 2 < n; ++i)
            out[i] = {0, i + 1, i + 2};
        return;
    }
    clipEars(out);
}

/// Drops the coordinate along which the polygon's Newell normal is longest. False when it has no area.
bool PolygonClipper::project(const std::vector<glm::vec3>& polygon) {
    const size_t n = polygon.size();
    const glm::dvec3 origin(polygon[0]);
    glm::dvec3 normal(0.0);
    for (size_t i = 0; i < n; ++i) {
        normal += glm::cross(glm::dvec3(polygon[i]) - origin, glm::dvec3(polygon[(i + 1) % n]) - origin);
    }
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    if (!(size[axis] > 0.0)) return false;
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    if (normal[axis] < 0.0) std::swap(u, v);
    _points.resize(n);
    for (size_t i = 0; i < n; ++i)
        _points[i] = glm::dvec2(polygon[i][u], polygon[i][v]);
    return true;
}

bool PolygonClipper::isConvex() const {
    const size_t n = _points.size();
    for (size_t i = 0; i < n; ++i) {
        if (area2(_points[i], _points[(i + 1) % n], _points[(i + 2) % n]) < 0.0) return false;
    }
    return true;
}

double PolygonClipper::turn(uint32_t i) const {
    return area2(_points[_previous[i]], _points[i], _points[_next[i]]);
}

bool PolygonClipper::isEar(uint32_t i, Strictness strictness) const {
    if (strictness == Strictness::Anything) return true;
    if (!(turn(i) > 0.0)) return false;
    const glm::dvec2 &a = _points[_previous[i]], &b = _points[i], &c = _points[_next[i]];
    const bool borderCounts = strictness == Strictness::NothingInsideOrOnBorder;
    for (uint32_t k = _next[_next[i]]; k != _previous[i]; k = _next[k]) {
        // Only corners that are not convex can be the deepest intruder. Those at a corner of the ear itself
        // are the two ends of a bridge to an inner loop.
        const glm::dvec2& p = _points[k];
        if (_isConvexCorner[k] || p == a || p == b || p == c) continue;
        const double nearest = std::min({area2(a, b, p), area2(b, c, p), area2(c, a, p)});
        if (borderCounts ? nearest >= 0.0 : nearest > 0.0) return false;
    }
    return true;
}

void PolygonClipper::unlink(uint32_t i) {
    const uint32_t before = _previous[i], after = _next[i];
    _next[before] = after;
    _previous[after] = before;
    _isConvexCorner[before] = turn(before) > 0.0;
    _isConvexCorner[after] = turn(after) > 0.0;
}

void PolygonClipper::clipEars(glm::uvec3* out) {
    const uint32_t n = uint32_t(_points.size());
    _next.resize(n);
    _previous.resize(n);
    _isConvexCorner.resize(n);
    for (uint32_t i = 0; i < n; ++i) {
        _next[i] = (i + 1) % n;
        _previous[i] = (i + n - 1) % n;
    }
    for (uint32_t i = 0; i < n; ++i)
        _isConvexCorner[i] = turn(i) > 0.0;

    uint32_t current = 0, misses = 0;
    Strictness strictness = Strictness::NothingInsideOrOnBorder;
    for (uint32_t remaining = n; remaining > 3;) {
        if (isEar(current, strictness)) {
            *out++ = {_previous[current], current, _next[current]};
            unlink(current);
            // Going on one corner further spreads the cuts, which avoids a fan of slivers.
            current = _next[_next[current]];
            --remaining;
            misses = 0;
            strictness = Strictness::NothingInsideOrOnBorder;
        } else {
            current = _next[current];
            if (++misses == remaining) {
                misses = 0;
                strictness = strictness == Strictness::NothingInsideOrOnBorder ? Strictness::NothingInside
                                                                               : Strictness::Anything;
            }
        }
    }
    *out = {_previous[current], current, _next[current]};
}

} // namespace hipr::geometry
