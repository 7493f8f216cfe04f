/// @file sharp_normals.h
/// Normals next to creases. Internal to renderer/geometry.
#pragma once

#include "renderer/geometry/refiner.h"
#include "renderer/geometry/subdivide.h"

namespace hipr::geometry {

/// A limit normal belongs to one smooth side of a crease, but a crease vertex has two or more sides. Gives
/// each side the angle-weighted mean of its own faces, in surface.cornerNormals. Leaves the surface alone
/// when no edge is sharp at the last level.
void splitNormalsAtCreases(const Far::TopologyRefiner& refiner, RefinedSurface& surface);

} // namespace hipr::geometry
