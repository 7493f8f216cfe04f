// The choice among many lights: its chances, and that no light is lost by it.
#include <cmath>
#include <map>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "renderer/shading/light_tree.h"
#include "testenv/unit/shading/light_kernel.h"

namespace hipr::test {
namespace {

constexpr double Pi = 3.14159265358979323846;

/// Lights of all kinds with a place, of all sizes, turned anywhere, some of them shaped, around the origin.
std::vector<LightDesc> crowd(size_t count, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.0, 1.0);
    std::vector<LightDesc> lights;
    for (size_t i = 0; i < count; ++i) {
        LightDesc light;
        light.name = "/light" + std::to_string(i);
        const LightKind kinds[] = {LightKind::Rect, LightKind::Sphere, LightKind::Disk, LightKind::Cylinder};
        light.kind = kinds[i % 4];
        const glm::dvec3 place(8.0 * uniform(random) - 4.0, 8.0 * uniform(random) - 4.0,
                               4.0 * uniform(random) - 1.0);
        const glm::dvec3 axis =
            glm::normalize(glm::dvec3(uniform(random), uniform(random), uniform(random)) - 0.4);
        light.transform = glm::translate(glm::dmat4(1.0), place) *
                          glm::rotate(glm::dmat4(1.0), 6.0 * uniform(random), axis) *
                          glm::scale(glm::dmat4(1.0), glm::dvec3(0.2 + uniform(random)));
        light.radius = float(0.02 + 0.2 * uniform(random));
        light.width = float(0.1 + 0.5 * uniform(random));
        light.intensity = float(std::exp2(6.0 * uniform(random)));
        if (i % 3 == 0) light.shaping.coneAngle = float(20.0 + 140.0 * uniform(random));
        light.thin = i % 8 == 1;
        lights.push_back(light);
    }
    return lights;
}

const std::vector<std::pair<glm::vec3, glm::vec3>>& places() {
    static const std::vector<std::pair<glm::vec3, glm::vec3>> all = {
        {{0, 0, 0}, {0, 0, 1}},
        {{6, -2, 0}, glm::normalize(glm::vec3(-1, 0.5f, 0.3f))},
        {{0.5f, 0.5f, -3}, {0, 0, 1}}};
    return all;
}

/// A walk may end where no child sends light to the point, though their common bounds might: then there is no
/// sample.
TEST(LightTree, ChancesAreMet) {
    const size_t count = 300, draws = 1 << 16;
    const LitScene scene(crowd(count));
    ASSERT_GT(scene.record().lightTreeChance, 0.f);
    const uint32_t inTree = scene.record().lightCount;
    for (const auto& [point, normal] : places()) {
        const std::vector<LightOutcome> outcomes = scene.run(point, normal, draws);
        double sum = 0.0;
        for (uint32_t i = 0; i < inTree; ++i)
            sum += double(outcomes[i].chanceOf);
        std::map<uint32_t, double> drawn;
        for (const LightOutcome& o : outcomes) {
            if (!(o.chance > 0.f)) continue;
            ASSERT_LT(o.chosen, inTree);
            ASSERT_NEAR(o.chance, outcomes[o.chosen].chanceOf, 1e-5f * o.chance);
            drawn[o.chosen] += 1.0;
        }
        double found = 0.0;
        for (const auto& [light, times] : drawn)
            found += times / double(draws);
        EXPECT_NEAR(sum, found, 2e-3);
        EXPECT_GT(found, 0.5);
        double chiSquare = 0.0;
        int freedom = -1;
        for (uint32_t i = 0; i < inTree; ++i) {
            const double expected = double(outcomes[i].chanceOf) * double(draws);
            if (expected == 0.0) {
                EXPECT_EQ(drawn.count(i), 0u);
            } else if (expected > 5.0) {
                chiSquare += (drawn[i] - expected) * (drawn[i] - expected) / expected;
                ++freedom;
            }
        }
        EXPECT_GT(freedom, 20);
        EXPECT_LT(chiSquare, freedom + 4.0 * std::sqrt(2.0 * freedom)); // Sobol points do better than chance
    }
}

/// What light samples find is what cosine-weighted rays find, and what each light gives alone.
TEST(LightTree, LosesNoLight) {
    std::vector<LightDesc> lights = crowd(60);
    for (LightDesc& light : lights)
        light.thin = false; // rays do not meet thin lights
    for (const auto& [point, normal] : places()) {
        const Irradiance e = irradiance(LitScene(lights), point, normal);
        double truth = 0.0;
        for (const LightDesc& light : lights)
            truth += irradiance(LitScene({light}), point, normal).byLight.y;
        EXPECT_NEAR(e.byLight.y, truth, 0.01 * truth);
        EXPECT_NEAR(e.combined.y, truth, 0.01 * truth);
        EXPECT_NEAR(e.byMeeting.y, truth, 0.03 * truth);
    }
}

/// Lights that are linked to other objects than the one here take no samples away, be they few or many.
TEST(LightTree, PassesOverLinkedLights) {
    for (const size_t count : {6u, 200u}) {
        std::vector<LightDesc> lights = crowd(count);
        for (size_t i = 0; i < lights.size(); ++i) {
            lights[i].shaping = {};
            if (i != 5) lights[i].lightLink = "/light" + std::to_string(i) + ".lightLink";
        }
        const LitScene scene(lights), alone({lights[5]});
        ASSERT_GT(scene.record().lightTreeChance, 0.f) << count;
        size_t samples = 0, drawn = 0;
        for (const LightOutcome& o : scene.run({0, 0, -3}, {0, 0, 1}, 4096)) {
            samples += o.pdf > 0.f;
            drawn += o.chance > 0.f;
            if (o.chance > 0.f) {
                EXPECT_EQ(o.chance, 1.f);
            }
        }
        size_t possible = 0;
        for (const LightOutcome& o : alone.run({0, 0, -3}, {0, 0, 1}, 4096))
            possible += o.pdf > 0.f;
        EXPECT_EQ(drawn, 4096u) << count;
        EXPECT_EQ(samples, possible) << count;
        EXPECT_GT(possible, 0u);
        const Irradiance linked = irradiance(scene, {0, 0, -3}, {0, 0, 1});
        EXPECT_NEAR(linked.combined.y, irradiance(alone, {0, 0, -3}, {0, 0, 1}).combined.y,
                    0.01 * linked.combined.y);
    }
}

TEST(LightTree, StandsBesideInfiniteLights) {
    std::vector<LightDesc> lights = crowd(40);
    LightDesc dome;
    dome.name = "/dome";
    dome.kind = LightKind::Dome;
    dome.intensity = 3.f;
    double truth = 3.0 * Pi;
    for (const LightDesc& light : lights)
        truth += irradiance(LitScene({light}), glm::vec3(0.f), {0, 0, 1}).byLight.y;
    lights.push_back(dome);
    const Irradiance e = irradiance(LitScene(lights), glm::vec3(0.f), {0, 0, 1});
    EXPECT_NEAR(e.byLight.y, truth, 0.01 * truth);
    EXPECT_NEAR(e.combined.y, truth, 0.01 * truth);
}

/// Samples go where the light comes from: the estimate from one light near and 999 far away has little noise.
TEST(LightTree, FindsTheLightThatMatters) {
    std::vector<LightDesc> lights = crowd(1000);
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i] = LightDesc();
        lights[i].name = "/light" + std::to_string(i);
        lights[i].radius = 0.1f;
        const double x = i == 500 ? 0.0 : 100.0 + double(i % 40), y = i == 500 ? 0.0 : double(i / 40);
        lights[i].transform = glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, 2.0));
    }
    size_t found = 0;
    const std::vector<LightOutcome> outcomes = LitScene(lights).run(glm::vec3(0.f), {0, 0, 1}, 4096);
    for (const LightOutcome& o : outcomes)
        found += o.pdf > 0.f && o.wi.z > 0.99f;
    EXPECT_GT(double(found), 0.5 * double(outcomes.size()));
}

std::vector<LightBounds> somewhere(size_t count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0.f, 1.f);
    std::vector<LightBounds> lights(count);
    for (LightBounds& light : lights) {
        light.lo = {uniform(random), uniform(random), uniform(random)};
        light.hi = light.lo + 0.1f;
        light.axis = glm::normalize(glm::vec3(uniform(random), uniform(random), uniform(random)) - 0.5f);
        light.emission = 0.5 * Pi;
        light.power = 1.0 + double(uniform(random));
    }
    return lights;
}

TEST(LightTree, NodesHoldTheirChildren) {
    const std::vector<LightBounds> lights = somewhere(500);
    std::vector<uint32_t> leaves;
    const std::vector<gpu::LightNode> nodes = buildLightTree(lights, leaves);
    ASSERT_EQ(nodes.size(), 2 * lights.size() - 1);
    for (size_t i = 0; i < lights.size(); ++i)
        EXPECT_EQ(nodes[leaves[i]].light, i);
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i].light != gpu::NO_INDEX) {
            EXPECT_EQ(nodes[i].next, i + 1);
            continue;
        }
        float power = 0.f;
        for (const uint32_t child : {i + 1, nodes[i + 1].next}) {
            const gpu::LightNode &node = nodes[i], &inner = nodes[child];
            power += inner.power;
            EXPECT_TRUE(glm::all(glm::lessThanEqual(node.lo, inner.lo)));
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(node.hi, inner.hi)));
            EXPECT_LE(node.cosEmission, inner.cosEmission);
            // The inner cone lies in the outer one.
            const double between = std::acos(glm::clamp(double(glm::dot(node.axis, inner.axis)), -1.0, 1.0));
            const double outerAngle = std::acos(double(node.cosSpread)),
                         innerAngle = std::acos(double(inner.cosSpread));
            EXPECT_LE(std::min(between + innerAngle, Pi), outerAngle + 1e-2);
        }
        EXPECT_NEAR(nodes[i].power, power, 1e-4f * power);
        EXPECT_EQ(nodes[nodes[i + 1].next].next, nodes[i].next);
    }
}

TEST(LightTree, TakesLightsInOnePlace) {
    const std::vector<LightBounds> lights(100, somewhere(1)[0]);
    std::vector<uint32_t> leaves;
    EXPECT_EQ(buildLightTree(lights, leaves).size(), 199u);
    EXPECT_TRUE(buildLightTree({}, leaves).empty());
}

} // namespace
} // namespace hipr::test
