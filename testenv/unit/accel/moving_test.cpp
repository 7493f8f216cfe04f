// Rays know the time: instances that move and meshes that deform are hit where they are when the ray is, by
// every traversal alike, and as often as testing every triangle one by one says.
#include <cmath>

#include <gtest/gtest.h>

#include "testenv/common/trace_scene.h"

namespace hipr::test {
namespace {

/// Those that know the time; ray query does not (Traversal::knowsTime()).
class MovingHits : public testing::TestWithParam<TraversalKind> {
protected:
    void expectDefinition(const RayScene& scene, std::vector<gpu::Ray> rays, double allowed = 0.0) {
        spreadOverTime(rays, 77);
        TraceScene traced(GetParam(), scene);
        const auto expected = bruteForce(scene, rays);
        const Difference d = compare(traced.nearest(rays), expected);
        EXPECT_LE(d.hits, uint32_t(allowed * double(rays.size()))) << "first: " << d.first;
        EXPECT_EQ(d.distances, 0u) << "first: " << d.first;
        const auto blocked = traced.occluded(rays);
        uint32_t found = 0, wrong = 0;
        for (size_t i = 0; i < rays.size(); ++i) {
            found += expected[i].instance != gpu::NO_INDEX;
            wrong += blocked[i] != (expected[i].instance != gpu::NO_INDEX ? 1u : 0u);
        }
        EXPECT_LE(wrong, uint32_t(allowed * double(rays.size())));
        EXPECT_GT(found, rays.size() / 20);
    }
    /// Embree only proposes hits: see Hits::allowedAimed() in hits_test.cpp.
    double allowedAimed() const { return GetParam() == TraversalKind::Embree ? 0.07 : 0.0; }
    void TearDown() override { EXPECT_EQ(device().validationErrors(), 0u); }
};

TEST_P(MovingHits, InstancesThatMove) {
    for (uint32_t instances : {1u, 30u}) {
        RayScene scene{{soup(60, 0.5f, 0.3f, 1), bumpySphere(6, 0.5f)}, {}};
        Random random(4);
        for (uint32_t i = 0; i < instances; ++i) {
            scene.instances.push_back(placed(i % 2, randomPlacement(random, 2.0f, i % 3 == 1)));
            if (i % 4 != 3) setMoving(scene, 2 + i % 5, random, 0.7f);
        }
        expectDefinition(scene, aimedRays(scene, 30000, 3.0f, 6), allowedAimed());
    }
}

TEST_P(MovingHits, MeshesThatDeform) {
    for (uint32_t keys : {2u, 3u, 6u}) {
        RayScene scene{{soup(200, 1.0f, 0.3f, 1), bumpySphere(9, 0.7f), grid(3, 0.5f, 1)}, {}};
        deform(scene.meshes[0], keys, 0.2f, 2);
        deform(scene.meshes[1], keys, 0.03f, 3);
        Random random(5);
        for (uint32_t i = 0; i < 6; ++i) {
            scene.instances.push_back(placed(i % 3, randomPlacement(random, 1.5f, i % 2)));
            if (i % 2) setMoving(scene, 3, random, 0.5f);
        }
        expectDefinition(scene, aimedRays(scene, 30000, 3.0f, 6), allowedAimed());
    }
}

TEST_P(MovingHits, ABallFliesPast) {
    RayScene scene{{bumpySphere(12, 0.5f)}, {placed(0, glm::dmat4(1.0))}};
    scene.instances[0].keyCount = 2;
    glm::mat4x3 from(1.0f), to(1.0f);
    from[3].x = -2.0f;
    to[3].x = 2.0f;
    scene.keys = {from, to};
    std::vector<gpu::Ray> rays;
    for (int i = 0; i <= 100; ++i) // along z, where the ball's middle comes by at time 3/4
        rays.push_back({{1.0f, 0.01f, -5.0f}, 0.0f, {0.0f, 0.0f, 1.0f}, 1e30f, float(i) / 100.0f, 0u});
    const auto hits = TraceScene(GetParam(), scene).nearest(rays);
    for (int i = 0; i <= 100; ++i) {
        const float away = std::abs(4.0f * float(i) / 100.0f - 3.0f); // the radius is 0.45 to 0.55
        if (std::abs(away - 0.48f) < 0.08f) continue;
        EXPECT_EQ(hits[size_t(i)].instance != gpu::NO_INDEX, away < 0.48f) << i;
    }
}

TEST_P(MovingHits, CurvesThatDeform) {
    for (uint32_t keys : {2u, 4u}) {
        RayScene scene{{strands(60, 0.8f, 0.2f, 0.05f, 1), soup(60, 0.5f, 0.3f, 1)}, {}};
        deform(scene.meshes[0], keys, 0.1f, 2);
        Random random(5);
        for (uint32_t i = 0; i < 6; ++i) {
            scene.instances.push_back(placed(i % 2, randomPlacement(random, 1.5f, i % 3)));
            if (i % 3) setMoving(scene, 3, random, 0.5f);
        }
        expectDefinition(scene, randomRays(30000, 2.0f, 6));
        scene.instances = {scene.instances[0]}; // of curves alone
        expectDefinition(scene, aimedRays(scene, 30000, 2.0f, 7));
    }
}

TEST_P(MovingHits, SidesThatRaysPass) {
    RayScene scene{{bumpySphere(7, 0.5f), soup(60, 0.5f, 0.3f, 1), strands(20, 0.5f, 0.2f, 0.05f, 3)}, {}};
    deform(scene.meshes[0], 3, 0.05f, 2);
    Random random(5);
    for (uint32_t i = 0; i < 20; ++i) {
        scene.instances.push_back(placed(i % 3, randomPlacement(random, 1.5f, i % 2)));
        if (i % 4) setMoving(scene, 3, random, 0.5f);
    }
    auto rays = randomRays(30000, 2.0f, 6);
    makeCull(scene, rays);
    expectDefinition(scene, rays);
}

/// Edits of keys give the hits of a scene built anew.
TEST_P(MovingHits, EditsOfKeys) {
    RayScene scene{{bumpySphere(8, 0.7f)}, {placed(0, glm::dmat4(1.0)), placed(0, glm::dmat4(1.0))}};
    deform(scene.meshes[0], 2, 0.05f, 3);
    TraceScene edited(GetParam(), scene);
    auto rays = randomRays(20000, 2.0f, 9);
    spreadOverTime(rays, 10);
    Random random(11);
    const auto expectFresh = [&](const char* what) {
        const Difference d = compare(edited.nearest(rays), TraceScene(GetParam(), scene).nearest(rays));
        EXPECT_EQ(d.hits + d.distances, 0u) << what;
    };
    setMoving(scene, 4, random, 0.5f);
    edited.setInstances(scene.instances, scene.keys);
    edited.commit();
    expectFresh("an instance starts to move");
    for (glm::vec3& p : scene.meshes[0].positions)
        p += random.point(0.02f);
    edited.movePoints(0, scene.meshes[0].positions);
    edited.commit();
    expectFresh("points of all keys");
    scene.keys[2][3].y += 1.0f;
    edited.setInstances(scene.instances, scene.keys);
    edited.commit();
    expectFresh("one key of the instance");
    scene.instances[1].keyCount = 0;
    scene.keys.clear();
    edited.setInstances(scene.instances, scene.keys);
    edited.commit();
    expectFresh("the instance stops");
}

INSTANTIATE_TEST_SUITE_P(All, MovingHits,
                         testing::Values(TraversalKind::Host, TraversalKind::Embree, TraversalKind::Bvh),
                         [](const auto& info) { return kindName(info.param); });

} // namespace
} // namespace hipr::test
