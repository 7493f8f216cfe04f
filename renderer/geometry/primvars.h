/// @file primvars.h
/// Primvars from polygons to triangles. Internal to renderer/geometry.
#pragma once

#include "renderer/geometry/triangulate.h"

namespace hipr::geometry {

/// Expands a primvar over the triangles. `cornerElement` gives, for each corner of the triangulated polygons,
/// the element of the view (empty: the corner itself); `faceElement` the same for each triangle.
TrianglePrimvar expandPrimvar(const PrimvarView& view, const Triangulation& triangulation,
                              const std::vector<uint32_t>& cornerElement,
                              const std::vector<uint32_t>& faceElement, size_t vertexCount);

} // namespace hipr::geometry
