/// @file instance_table.h
/// World boxes and traversal records of all instances; the same for every traversal, because a canonical hit
/// depends on them (shaders/shared/intersect.h).
#pragma once

#include <functional>
#include <vector>

#include "renderer/accel/bounds.h"
#include "shaders/shared/bvh.h"
#include "shaders/shared/scene.h"

namespace hipr {

struct InstanceTable {
    std::vector<gpu::BvhInstance>
        records;         ///< one per instance, in order; `mask` is 0 for instances of nothing
    Bounds bounds;       ///< of all records with a mask
    float extent = 0.0f; ///< largest |coordinate| of `bounds`
};

/// `geometryBounds(slot)` is the object-space box of a geometry slot, empty when it holds no triangle. Boxes
/// are grown by what rounding can move a ray when it is mapped to object space, so that the world box of an
/// instance holds every hit in it for origins about as far away as the scene is large. Placements that are
/// singular or not finite get mask 0.
InstanceTable makeInstanceTable(const std::vector<gpu::InstanceRecord>& instances,
                                const std::function<Bounds(uint32_t slot)>& geometryBounds);

} // namespace hipr
