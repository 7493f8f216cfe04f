// Wide trees and every compilation of the walk through them that this processor runs.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/accel/denormals.h"
#include "renderer/accel/geometry_bounds.h"
#include "renderer/accel/instance_table.h"
#include "renderer/accel/wide_walk.h"
#include "testenv/common/trace_scene.h"

namespace hipr::test {
namespace {

/// Counts how often each triangle is in a leaf, and expects its corners there and its box within all above.
struct Inspection {
    const TriangleMesh& mesh;
    const WideUnit* units;
    std::vector<uint32_t> seen = std::vector<uint32_t>(mesh.size(), 0);

    static void expectWithin(const glm::vec3& p, const Bounds& box) {
        EXPECT_TRUE(glm::all(glm::lessThanEqual(box.lo, p)) && glm::all(glm::lessThanEqual(p, box.hi)));
    }
    void node(uint32_t index, const Bounds& box) {
        const auto& n = reinterpret_cast<const WideNode&>(units[index]);
        for (uint32_t lane = 0; lane < WIDE_CHILDREN; ++lane) {
            const Bounds b{{n.plane[0][lane], n.plane[2][lane], n.plane[4][lane]},
                           {n.plane[1][lane], n.plane[3][lane], n.plane[5][lane]}};
            if (n.child[lane] == WIDE_NOTHING) {
                EXPECT_GT(b.lo.x, b.hi.x);
                continue;
            }
            expectWithin(b.lo, box);
            expectWithin(b.hi, box);
            n.child[lane] & WIDE_LEAF ? leaf(n.child[lane] & ~WIDE_LEAF, b) : node(n.child[lane], b);
        }
    }
    void leaf(uint32_t index, const Bounds& box) {
        const auto& l = reinterpret_cast<const WideLeaf&>(units[index]);
        for (uint32_t lane = 0; lane < WideLeaf::TRIANGLES; ++lane) {
            if (l.primitive[lane] == ~0u) {
                EXPECT_TRUE(std::isnan(l.corner[0][0][lane]));
                continue;
            }
            ++seen.at(l.primitive[lane]);
            const GeometryView view = viewOf(mesh);
            const Corners corners = cornersOf(view, l.primitive[lane], 0);
            for (int k = 0; k < 3; ++k)
                EXPECT_EQ(corners[k],
                          glm::vec3(l.corner[k][0][lane], l.corner[k][1][lane], l.corner[k][2][lane]));
            expectWithin(cornersBox(view, corners).lo, box);
            expectWithin(cornersBox(view, corners).hi, box);
        }
    }
};

void expectHolds(const WideTree& tree, const TriangleMesh& mesh) {
    ASSERT_TRUE(tree.units());
    Inspection inspection{mesh, tree.units()};
    inspection.node(0, tree.bounds());
    for (uint32_t n : inspection.seen)
        ASSERT_EQ(n, 1u);
}

TEST(WideTree, HoldsEveryTriangleOnce) {
    for (uint32_t count : {1u, 4u, 5u, 33u, 3000u}) {
        const TriangleMesh mesh = soup(count, 1.0f, 0.2f, count);
        WideTree tree;
        tree.build(viewOf(mesh));
        expectHolds(tree, mesh);
        const TriangleMesh curves = strands(count, 1.0f, 0.2f, 0.05f, count);
        tree.build(viewOf(curves));
        expectHolds(tree, curves);
    }
    TriangleMesh same = soup(1, 1.0f, 0.2f, 1); // one triangle many times
    same.triangles.resize(1000, same.triangles[0]);
    WideTree tree;
    tree.build(viewOf(same));
    expectHolds(tree, same);
    tree.build(viewOf({}));
    EXPECT_FALSE(tree.units());
    EXPECT_TRUE(tree.bounds().empty());
}

TEST(WideTree, RefitFollowsPointsUntilItIsWornOut) {
    TriangleMesh mesh = bumpySphere(40, 1.0f);
    WideTree tree;
    tree.build(viewOf(mesh));
    for (glm::vec3& p : mesh.positions)
        p = p * glm::vec3(1.0f, 2.0f, 1.0f) + glm::vec3(7.0f, 0.0f, 0.0f);
    EXPECT_TRUE(tree.refit(viewOf(mesh)));
    expectHolds(tree, mesh);
    EXPECT_GT(tree.bounds().lo.x, 5.5f);
    Random random(1);
    for (glm::vec3& p : mesh.positions)
        p = random.point(1.0f);
    EXPECT_FALSE(tree.refit(viewOf(mesh)));
    expectHolds(tree, mesh);
}

/// A scene as a walk sees it.
struct Walked {
    explicit Walked(const RayScene& s) : scene(s), trees(s.meshes.size()) {
        for (size_t i = 0; i < trees.size(); ++i)
            trees[i].build(viewOf(s.meshes[i]));
        table = makeInstanceTable({s.instances, s.keys}, [&](uint32_t slot) {
            return slotShape(viewOf(s.meshes[slot]), trees[slot].bounds());
        });
        std::vector<Bounds> boxes;
        std::vector<uint32_t> ids;
        for (uint32_t i = 0; i < table.records.size(); ++i) {
            table.records[i].nodes = reinterpret_cast<uint64_t>(trees[s.instances[i].geometry].units());
            boxes.push_back({table.records[i].lo, table.records[i].hi});
            ids.push_back(i);
        }
        top.build(boxes, ids);
    }
    void expectDefinition(const WideWalk& walk, const std::vector<gpu::Ray>& rays) const {
        const FlushDenormals flush;
        const uint32_t count = uint32_t(rays.size());
        const WideScene wide{table.records.data(), uint32_t(table.records.size()), table.extent, top.units(),
                             table.keys.data()};
        std::vector<gpu::Hit> hits(count);
        std::vector<uint32_t> blocked(count);
        walk.nearest(wide, gpu::RAY_MASK_ALL, rays.data(), count, hits.data());
        walk.occluded(wide, gpu::RAY_MASK_ALL, rays.data(), count, blocked.data());
        const auto expected = bruteForce(scene, rays);
        const Difference d = compare(hits, expected);
        EXPECT_EQ(d.hits + d.distances, 0u) << walk.name << ", first: " << d.first;
        uint32_t met = 0;
        for (uint32_t i = 0; i < count; ++i) {
            ASSERT_EQ(blocked[i], expected[i].instance == gpu::NO_INDEX ? 0u : 1u)
                << walk.name << ", ray " << i;
            met += blocked[i];
        }
        EXPECT_GT(met, count / 20);
    }
    const RayScene& scene;
    std::vector<WideTree> trees;
    InstanceTable table;
    WideTree top;
};

TEST(WideWalk, EveryCompilationGivesTheDefinition) {
    RayScene scene{
        {soup(40, 0.5f, 0.3f, 1), bumpySphere(7, 0.5f), grid(3, 0.5f, 1), strands(20, 0.5f, 0.2f, 0.05f, 3)},
        {}};
    Random random(2);
    for (uint32_t i = 0; i < 40; ++i)
        scene.instances.push_back(placed(i % 4, randomPlacement(random, 2.0f, i % 2)));
    const RayScene alone{{bumpySphere(9, 1.0f)}, {placed(0, glm::dmat4(1.0))}};
    auto segments = randomRays(10000, 3.0f, 5); // also behind the origin, where distances are negative
    for (gpu::Ray& r : segments)
        r.tMin = random.between(-2.0f, 0.5f), r.tMax = random.between(r.tMin, 3.0f);
    for (const WideWalk* walk : wideWalks()) {
        Walked(scene).expectDefinition(*walk, randomRays(20000, 3.0f, 3));
        Walked(scene).expectDefinition(*walk, aimedRays(scene, 20000, 3.0f, 4));
        Walked(scene).expectDefinition(*walk, segments);
        Walked(alone).expectDefinition(*walk, aimedRays(alone, 20000, 0.3f, 6));
    }
    auto passing = randomRays(20000, 3.0f, 3);
    makeCull(scene, passing);
    for (const WideWalk* walk : wideWalks())
        Walked(scene).expectDefinition(*walk, passing);
}

TEST(WideWalk, EveryCompilationKnowsTheTime) {
    RayScene scene{{soup(40, 0.5f, 0.3f, 1), bumpySphere(7, 0.5f), strands(20, 0.5f, 0.2f, 0.05f, 3)}, {}};
    deform(scene.meshes[1], 3, 0.05f, 8);
    deform(scene.meshes[2], 3, 0.05f, 9);
    Random random(2);
    for (uint32_t i = 0; i < 30; ++i) {
        scene.instances.push_back(placed(i % 3, randomPlacement(random, 2.0f, i % 2)));
        if (i % 3) setMoving(scene, 2 + i % 3, random, 0.5f);
    }
    auto rays = aimedRays(scene, 20000, 3.0f, 4);
    spreadOverTime(rays, 5);
    for (const WideWalk* walk : wideWalks())
        Walked(scene).expectDefinition(*walk, rays);
}

} // namespace
} // namespace hipr::test
