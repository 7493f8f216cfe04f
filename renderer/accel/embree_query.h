/// @file embree_query.h
/// Canonical rays through an EmbreeScene.
#pragma once

#include "renderer/accel/embree_scene.h"
#include "shaders/shared/scene.h"

namespace hipr {

/// Embree proposes triangles, shaders/shared/intersect.h decides: filter callbacks recompute each candidate
/// and keep the best one. Where Embree's own rounding may have hidden a neighbour (next to an edge, or when
/// it proposed a triangle that the canonical test turns down) a point query collects all triangles around
/// that point.
EmbreeCallbacks embreeCallbacks();

gpu::Hit embreeNearest(const EmbreeScene& scene, const gpu::Ray& ray, uint32_t mask);
bool embreeOccluded(const EmbreeScene& scene, const gpu::Ray& ray, uint32_t mask);

} // namespace hipr
