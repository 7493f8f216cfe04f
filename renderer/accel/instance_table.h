/// @file instance_table.h
/// World boxes and traversal records of all instances; the same for every traversal, because a canonical hit
/// depends on them (shaders/shared/intersect.h).
#pragma once

#include <functional>
#include <vector>

#include "renderer/accel/bounds.h"
#include "renderer/accel/traversal.h"
#include "shaders/shared/bvh.h"
#include "shaders/shared/motion.h"
#include "shaders/shared/scene.h"

namespace hipr {

struct InstanceTable {
    std::vector<glm::mat4x3> keys; ///< of moving instances, see BvhInstance::firstKey
    std::vector<gpu::BvhInstance>
        records;         ///< one per instance, in order; `mask` is 0 for instances of nothing
    Bounds bounds;       ///< of all records with a mask
    float extent = 0.0f; ///< largest |coordinate| of `bounds`
    bool culls = false;  ///< some instance has INSTANCE_CULL_*
};

/// What the table needs of a geometry slot.
struct SlotShape {
    Bounds bounds; ///< object space, at all times of the shutter; empty when it holds no triangle
    uint32_t keys = 1, triangleCount = 0;
    bool segments = false; ///< round ones in place of triangles
};
inline SlotShape slotShape(const GeometryView& view, const Bounds& bounds) {
    return {bounds, view.keys, view.triangleCount, view.segments != nullptr};
}

/// `shapeOf(slot)` is what a geometry slot holds. Boxes are of all times of the shutter, and
/// are grown by what rounding can move a ray when it is mapped to object space, so that the world box of an
/// instance holds every hit in it for origins about as far away as the scene is large. Placements that are
/// singular or not finite get mask 0.
InstanceTable makeInstanceTable(const InstanceView& instances,
                                const std::function<SlotShape(uint32_t slot)>& shapeOf);

/// World to object at a time of the shutter.
inline glm::mat4x3 worldToObject(const gpu::BvhInstance& instance, const glm::mat4x3* keys, float time) {
    if (instance.keyCount == 0) return instance.worldToObject;
    const gpu::KeyTime at = gpu::keyTime(time, instance.keyCount);
    const glm::mat4x3* key = keys + instance.firstKey + at.first;
    return gpu::inverseTransform(gpu::mixTransforms(key[0], key[1], at.weight));
}

} // namespace hipr
