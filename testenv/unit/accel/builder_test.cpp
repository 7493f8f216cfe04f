#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <tbb/global_control.h>

#include "renderer/accel/bvh_builder.h"
#include "testenv/common/ray_scenes.h"

namespace hipr::test {
namespace {

bool contains(const Bounds& outer, const Bounds& inner) {
    return glm::all(glm::lessThanEqual(outer.lo, inner.lo)) &&
           glm::all(glm::greaterThanEqual(outer.hi, inner.hi));
}

/// Every primitive is in exactly one leaf, every box holds what is below it, and the depth is bounded.
void expectValid(const Bvh& bvh, const std::vector<Bounds>& boxes, const BvhOptions& options) {
    ASSERT_FALSE(bvh.nodes.empty());
    std::vector<uint32_t> seen(boxes.size(), 0);
    std::function<void(uint32_t, const Bounds&, uint32_t)> visit = [&](uint32_t child, const Bounds& box,
                                                                       uint32_t depth) {
        if (child & gpu::BVH_LEAF) {
            const uint32_t first = child & gpu::BVH_FIRST_MASK;
            const uint32_t count = child >> gpu::BVH_COUNT_SHIFT & gpu::BVH_COUNT_MASK;
            ASSERT_LE(count, options.maxLeaf);
            for (uint32_t i = first; i < first + count; ++i) {
                ++seen[bvh.order[i]];
                EXPECT_TRUE(contains(box, boxes[bvh.order[i]]));
            }
            return;
        }
        ASSERT_LT(depth, options.maxDepth);
        ASSERT_LT(child, bvh.nodes.size());
        const gpu::BvhNode& n = bvh.nodes[child];
        for (const auto& [next, lo, hi] :
             {std::tuple(n.child0, n.lo0, n.hi0), std::tuple(n.child1, n.lo1, n.hi1)}) {
            if (next == gpu::BVH_EMPTY) continue;
            ASSERT_TRUE((next & gpu::BVH_LEAF) || next > child);
            EXPECT_TRUE(contains(box, {lo, hi}));
            visit(next, {lo, hi}, depth + 1);
        }
    };
    visit(0, bvh.bounds, 0);
    for (uint32_t n : seen)
        ASSERT_EQ(n, 1u);
}

std::vector<Bounds> randomBoxes(uint32_t count, float half, float size, uint32_t seed) {
    Random random(seed);
    std::vector<Bounds> boxes(count);
    for (Bounds& b : boxes) {
        const glm::vec3 p = random.point(half);
        b.add(p);
        b.add(p + random.point(size));
    }
    return boxes;
}

void expectBuilds(const std::vector<Bounds>& boxes, const BvhOptions& options = {}) {
    expectValid(buildBvh(boxes, options), boxes, options);
}

TEST(Builder, AnyCount) {
    for (uint32_t n : {0u, 1u, 2u, 3u, 4u, 5u, 100u, 5000u})
        expectBuilds(randomBoxes(n, 1.0f, 0.1f, n));
    for (uint32_t n : {0u, 1u, 2u, 17u})
        expectBuilds(randomBoxes(n, 1.0f, 0.1f, n), {1, gpu::BVH_MAX_INSTANCE_DEPTH, 1.0f});
    expectBuilds(randomBoxes(300000, 1.0f, 0.01f, 7)); // binned and built in parallel
}

TEST(Builder, DegenerateInput) {
    expectBuilds(std::vector<Bounds>(100000, Bounds{glm::vec3(1.0f), glm::vec3(1.0f)}));  // one point
    expectBuilds(std::vector<Bounds>(100000, Bounds{glm::vec3(-1.0f), glm::vec3(1.0f)})); // one box
    expectBuilds(randomBoxes(10000, 3e38f, 0.0f, 1));                                     // sizes overflow
    expectBuilds(randomBoxes(10000, 1e-42f, 1e-43f, 2));                                  // denormals
    std::vector<Bounds> line; // each split would take off one primitive
    for (int i = 0; i < 10000; ++i) {
        const glm::vec3 p(std::pow(2.0f, float(i % 200) - 100.0f), 0.0f, 0.0f);
        line.push_back({p, p});
    }
    expectBuilds(line);
    std::vector<Bounds> nested;
    for (int i = 0; i < 10000; ++i)
        nested.push_back({glm::vec3(0.0f), glm::vec3(std::pow(1.005f, float(i)))});
    expectBuilds(nested);
    expectBuilds(nested, {1, 14, 1.0f}); // exactly as deep as a balanced tree
}

TEST(Builder, TooManyPrimitives) {
    EXPECT_THROW(buildBvh(randomBoxes(17, 1.0f, 0.1f, 1), {1, 4, 1.0f}), std::runtime_error);
}

TEST(Builder, DoesNotDependOnThreads) {
    const auto boxes = randomBoxes(200000, 1.0f, 0.01f, 3);
    const Bvh many = buildBvh(boxes, {});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const Bvh single = buildBvh(boxes, {});
    ASSERT_EQ(many.nodes.size(), single.nodes.size());
    EXPECT_EQ(many.order, single.order);
    EXPECT_EQ(many.cost, single.cost);
}

TEST(Builder, IsGood) {
    const auto boxes = randomBoxes(20000, 1.0f, 0.02f, 4);
    const Bvh bvh = buildBvh(boxes, {});
    Bvh halved = bvh; // the same tree over shuffled primitives is what a bad builder makes
    std::vector<Bounds> shuffled = boxes;
    std::reverse(shuffled.begin(), shuffled.begin() + 10000);
    refitBvh(halved, shuffled, {});
    EXPECT_LT(bvh.cost, 70.0f);
    EXPECT_GT(halved.cost, 4.0f * bvh.cost);
}

TEST(Builder, RefitKeepsBoxesTight) {
    auto boxes = randomBoxes(5000, 1.0f, 0.05f, 5);
    Bvh bvh = buildBvh(boxes, {});
    const float built = bvh.cost;
    refitBvh(bvh, boxes, {});
    EXPECT_FLOAT_EQ(bvh.cost, built);
    for (Bounds& b : boxes)
        b.lo += glm::vec3(5.0f, 0.0f, 0.0f), b.hi += glm::vec3(5.0f, 0.0f, 0.0f);
    refitBvh(bvh, boxes, {});
    expectValid(bvh, boxes, {});
    EXPECT_NEAR(bvh.cost, built, 0.01f * built);
    EXPECT_GT(bvh.bounds.lo.x, 3.5f);
}

} // namespace
} // namespace hipr::test
