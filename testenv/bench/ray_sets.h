/// @file ray_sets.h
/// The kinds of rays a path tracer shoots.
#pragma once

#include "testenv/bench/bare_embree.h"

namespace hipr::bench {

struct RaySet {
    const char* kind;
    bool occlusion;
    std::vector<gpu::Ray> rays;
};

/// Primary: through the pixels of a size x size picture, in tiles of 8 x 8. Incoherent: cosine-distributed
/// bounces off what those hit. Shadow: from there to random points on the ceiling light.
std::vector<RaySet> raySets(const BareEmbree& embree, const TriangleMesh& mesh, uint32_t size);

} // namespace hipr::bench
