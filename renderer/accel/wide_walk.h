/// @file wide_walk.h
/// Canonical rays through wide trees on the host.
#pragma once

#include "renderer/accel/instance_table.h"
#include "renderer/accel/wide_tree.h"
#include "shaders/shared/scene.h"

namespace hipr {

struct WideScene {
    const gpu::BvhInstance* instances; ///< `nodes` is the host address of the geometry's WideUnit array
    uint32_t instanceCount;
    float extent;                      ///< largest |coordinate| of all instance boxes
    const WideUnit* top;               ///< leaves are instances; null: none
    const glm::mat4x3* keys = nullptr; ///< of moving instances
};

/// One compilation of the walk.
struct WideWalk {
    const char* name;
    /// hits[i], or blocked[i] (1 or 0), for rays[0 .. count).
    void (*nearest)(const WideScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
                    gpu::Hit* hits);
    void (*occluded)(const WideScene& scene, uint32_t mask, const gpu::Ray* rays, uint32_t count,
                     uint32_t* blocked);
};

extern const WideWalk plainWideWalk; ///< for every processor
#if defined(__x86_64__)
extern const WideWalk avx2WideWalk;   ///< needs AVX2 and BMI
extern const WideWalk avx512WideWalk; ///< needs AVX-512 F, VL, DQ and BW, too
#endif

/// Those that this processor runs, the fastest first.
std::vector<const WideWalk*> wideWalks();

} // namespace hipr
