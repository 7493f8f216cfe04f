/// @file bvh_builder.h
/// Binary bounding volume hierarchies by the surface area heuristic, for both levels.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/accel/bounds.h"
#include "shaders/shared/bvh.h"

namespace hipr {

struct BvhOptions {
    /// Primitives per leaf, 1..15.
    uint32_t maxLeaf = 4;
    /// Inner nodes from the root to a leaf.
    uint32_t maxDepth = gpu::BVH_MAX_TRIANGLE_DEPTH;
    /// Visiting a node, in units of one block's test.
    float nodeCost = 1.0f;
    /// Primitives that are tested together, for the price of one.
    uint32_t block = 1;
};

/// A tree over primitives 0..n-1. nodes[0] is the root, children come after their parents.
struct Bvh {
    std::vector<gpu::BvhNode> nodes;
    std::vector<uint32_t> order; ///< leaf entry -> primitive
    Bounds bounds;
    float cost = 0.0f; ///< expected node visits and primitive tests of a ray that meets `bounds`
};

/// Builds from the primitives' boxes (finite). Deterministic, whatever the number of threads. Top-down, 16
/// bins an axis (Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", RT 2007); degenerate
/// inputs fall back to halving, which also keeps the depth within the limit. Throws std::runtime_error above
/// maxLeaf * 2^maxDepth or 2^27 primitives.
Bvh buildBvh(const std::vector<Bounds>& boxes, const BvhOptions& options);

/// Recomputes all boxes and the cost for new primitive boxes, keeping the tree.
void refitBvh(Bvh& bvh, const std::vector<Bounds>& boxes, const BvhOptions& options);

} // namespace hipr
