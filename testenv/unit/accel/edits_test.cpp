// Hits after any sequence of edits are those of a scene built at once, to the last bit.
#include <gtest/gtest.h>

#include "testenv/common/trace_scene.h"

namespace hipr::test {
namespace {

class Edits : public testing::TestWithParam<TraversalKind> {};

/// Does one random thing to the scene, both to its description and to its traversal.
void edit(Random& random, RayScene& scene, TraceScene& traced) {
    const uint32_t slot = random.below(uint32_t(scene.meshes.size()));
    TriangleMesh& mesh = scene.meshes[slot];
    switch (random.below(7)) {
    case 0: // another mesh
        mesh = soup(1 + random.below(60), 0.5f, 0.3f, random.below(1000));
        traced.setMesh(slot, mesh);
        break;
    case 1: // small motion: refits
        for (glm::vec3& p : mesh.positions)
            p += random.point(0.05f);
        traced.movePoints(slot, mesh.positions);
        break;
    case 2: // wild motion: the tree wears out
        for (glm::vec3& p : mesh.positions)
            p = random.point(0.7f);
        traced.movePoints(slot, mesh.positions);
        break;
    case 3: // replaced and moved before the next commit
        mesh = soup(1 + random.below(60), 0.5f, 0.3f, random.below(1000));
        traced.setMesh(slot, mesh);
        for (glm::vec3& p : mesh.positions)
            p += random.point(0.2f);
        traced.movePoints(slot, mesh.positions);
        break;
    case 4: // emptied; instances of it stay
        mesh = {};
        traced.removeMesh(slot);
        traced.setMesh(slot, mesh);
        break;
    case 5: // curves
        mesh = strands(1 + random.below(20), 0.5f, 0.2f, 0.05f, random.below(1000));
        traced.setMesh(slot, mesh);
        break;
    default: // instances come, go and move
        if (scene.instances.size() > 8) scene.instances.erase(scene.instances.begin() + random.below(8));
        scene.instances.push_back(placed(slot, randomPlacement(random, 1.0f, true)));
        scene.instances[random.below(uint32_t(scene.instances.size()))] = placed(
            slot, randomPlacement(random, 1.0f, false), random.below(2) ? gpu::INSTANCE_NON_OPAQUE : 0u);
        traced.setInstances(scene.instances);
    }
}

TEST_P(Edits, LikeAFreshBuild) {
    Random random(1);
    RayScene scene{{soup(30, 0.5f, 0.3f, 1), bumpySphere(6, 0.5f), soup(5, 0.5f, 0.3f, 2)}, {}};
    for (uint32_t i = 0; i < 6; ++i)
        scene.instances.push_back(placed(i % 3, randomPlacement(random, 1.0f, true)));
    TraceScene traced(GetParam(), scene);
    const auto rays = randomRays(GetParam() == TraversalKind::RayQuery ? 500 : 3000, 2.0f, 3);
    uint32_t hits = 0;
    for (int step = 0; step < 60; ++step) {
        for (uint32_t k = 0; k <= random.below(3); ++k)
            edit(random, scene, traced);
        traced.commit();
        const auto now = traced.nearest(rays);
        const Difference fresh = compare(now, TraceScene(GetParam(), scene).nearest(rays));
        ASSERT_EQ(fresh.hits + fresh.distances, 0u) << "step " << step << ", ray " << fresh.first;
        const Difference defined = compare(now, bruteForce(scene, rays));
        ASSERT_EQ(defined.hits + defined.distances, 0u) << "step " << step << ", ray " << defined.first;
        for (const gpu::Hit& h : now)
            hits += h.instance != gpu::NO_INDEX;
    }
    EXPECT_GT(hits, uint32_t(rays.size()));
    EXPECT_EQ(device().validationErrors(), 0u);
}

/// A sphere that turns inside out over a hundred commits, which refits alone would not survive.
TEST_P(Edits, LongAnimation) {
    RayScene scene{{bumpySphere(20, 1.0f)}, {placed(0, glm::dmat4(1.0))}};
    const auto start = scene.meshes[0].positions;
    TraceScene traced(GetParam(), scene);
    const auto rays = randomRays(300, 1.5f, 4);
    for (int frame = 1; frame <= 50; ++frame) {
        const float s = 1.0f - 0.04f * float(frame);
        for (size_t i = 0; i < start.size(); ++i)
            scene.meshes[0].positions[i] = start[i] * glm::vec3(s, 1.0f, s * s);
        traced.movePoints(0, scene.meshes[0].positions);
        traced.commit();
        const Difference d = compare(traced.nearest(rays), bruteForce(scene, rays));
        ASSERT_EQ(d.hits + d.distances, 0u) << "frame " << frame << ", ray " << d.first;
    }
}

INSTANTIATE_TEST_SUITE_P(Traversals, Edits, testing::ValuesIn(ALL_TRAVERSALS),
                         [](const auto& info) { return kindName(info.param); });

} // namespace
} // namespace hipr::test
