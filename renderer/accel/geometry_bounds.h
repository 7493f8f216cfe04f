/// @file geometry_bounds.h
/// Boxes of geometries and their triangles at all times of the shutter, object space.
#pragma once

#include <vector>

#include "renderer/accel/bounds.h"
#include "renderer/accel/traversal.h"

namespace hipr {

Bounds triangleBounds(const GeometryView& view, uint32_t triangle);
std::vector<Bounds> triangleBoxes(const GeometryView& view);
/// Of all triangles; vertices that no triangle uses do not count.
Bounds geometryBounds(const GeometryView& view);

} // namespace hipr
