/// @file geometry_bounds.h
/// Corners of what geometries are made of, and boxes at all times of the shutter, object space.
#pragma once

#include <array>
#include <vector>

#include "renderer/accel/bounds.h"
#include "renderer/accel/traversal.h"

namespace hipr {

/// The corners of a triangle; of a round segment its two vertices, and then the radii there in x and y.
using Corners = std::array<glm::vec3, 3>;
Corners cornersOf(const GeometryView& view, uint32_t primitive, uint32_t key);
/// Their box, by the rounding of shaders/shared/segment.h.
Bounds cornersBox(const GeometryView& view, const Corners& corners);

/// Of every triangle or segment.
std::vector<Bounds> primitiveBoxes(const GeometryView& view);
/// Of all of them; vertices that none uses do not count.
Bounds geometryBounds(const GeometryView& view);

} // namespace hipr
