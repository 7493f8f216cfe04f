// How far clouds reach.
#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>

#include "renderer/splats/bounds.h"

namespace hipr::test {
namespace {

void expectBox(const SplatBox& box, glm::vec3 lo, glm::vec3 hi) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(box.lo[c], lo[c], 1e-5f) << c;
        EXPECT_NEAR(box.hi[c], hi[c], 1e-5f) << c;
    }
}

TEST(SplatBox, IsTightAroundTurnedSplats) {
    SplatCloud cloud;
    cloud.positions = {{1, 2, 3}};
    expectBox(splatBox(cloud, 2.f), {-1, 0, 1}, {3, 4, 5}); // without scales
    cloud.scales = {{1.f, 0.5f, 0.f}};
    expectBox(splatBox(cloud, 2.f), {-1, 1, 3}, {3, 3, 3});
    cloud.orientations = {glm::angleAxis(glm::radians(90.f), glm::vec3(0, 0, 1))};
    expectBox(splatBox(cloud, 2.f), {0, 0, 3}, {2, 4, 3});
    cloud.orientations[0] *= 3.f; // of any length
    expectBox(splatBox(cloud, 2.f), {0, 0, 3}, {2, 4, 3});
    cloud.orientations = {glm::angleAxis(glm::radians(45.f), glm::vec3(0, 0, 1))};
    const float half = 2.f * std::sqrt(0.5f * (1.f + 0.25f));
    expectBox(splatBox(cloud, 2.f), {1 - half, 2 - half, 3}, {1 + half, 2 + half, 3});
}

TEST(SplatBox, LeavesOutWhatIsNoNumber) {
    SplatCloud cloud;
    EXPECT_TRUE(splatBox(cloud, 3.f).empty());
    cloud.positions = {{NAN, 0, 0}};
    cloud.scales = {glm::vec3(1)};
    EXPECT_TRUE(splatBox(cloud, 3.f).empty());
    cloud.positions = {{NAN, 0, 0}, {5, 5, 5}, {0, INFINITY, 0}, {6, 5, 4}};
    cloud.scales.resize(4, glm::vec3(0));
    expectBox(splatBox(cloud, 3.f), {5, 5, 4}, {6, 5, 5});
}

} // namespace
} // namespace hipr::test
