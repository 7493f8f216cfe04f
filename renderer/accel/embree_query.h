/// @file embree_query.h
/// Canonical rays through an EmbreeScene.
#pragma once

#include "renderer/accel/embree_scene.h"
#include "shaders/shared/scene.h"

namespace hipr {

/// Embree proposes triangles, shaders/shared/intersect.h decides. Proposals around the nearest distance are
/// collected and tested at the end, usually one. Where Embree's own rounding may have hidden a neighbour (on
/// an edge, or when it proposed a triangle that the canonical test turns down) every proposal is tested on
/// the way, and point queries collect all triangles around the doubtful points.
EmbreeCallbacks embreeCallbacks();

/// hits[i] and blocked[i] (1 or 0) for rays[0 .. count). Give it some hundred rays at a time: memory latency
/// of the final tests is hidden behind other rays.
void embreeNearest(const EmbreeScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
                   gpu::Hit* hits);
void embreeOccluded(const EmbreeScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
                    uint32_t* blocked);

} // namespace hipr
