// What is done to every cloud before it is rendered.
#include "renderer/splats/tidy.h"
#include "splat_kit.h"

namespace hipr::test {
namespace {

TEST(Tidy, LeavesAGoodCloudAlone) {
    SplatCloud cloud = randomCloud(20, 2);
    const SplatCloud before = cloud;
    Messages messages;
    tidySplats(cloud, messages.options().messages);
    EXPECT_TRUE(messages.texts.empty());
    expectNear(cloud, before, 1e-6f);
    EXPECT_EQ(cloud.scales, before.scales);
}

TEST(Tidy, DropsWhatIsNoSplatFromAllArrays) {
    SplatCloud cloud = randomCloud(6, 1);
    const SplatCloud before = cloud;
    cloud.positions[0].z = INFINITY;
    cloud.orientations[2] = glm::quat(0.f, 0.f, 0.f, 0.f);
    cloud.coefficients[4 * 4 + 3].y = NAN;
    Messages messages;
    tidySplats(cloud, messages.options().messages);
    ASSERT_EQ(cloud.size(), 3u);
    for (const auto& [now, then] : {std::pair(0, 1), std::pair(1, 3), std::pair(2, 5)}) {
        EXPECT_EQ(cloud.positions[size_t(now)], before.positions[size_t(then)]);
        EXPECT_EQ(cloud.opacities[size_t(now)], before.opacities[size_t(then)]);
        EXPECT_EQ(cloud.scales[size_t(now)], before.scales[size_t(then)]);
        EXPECT_EQ(cloud.coefficients[size_t(now) * 4 + 3], before.coefficients[size_t(then) * 4 + 3]);
    }
    EXPECT_EQ(cloud.orientations.size(), 3u);
    EXPECT_EQ(cloud.coefficients.size(), 12u);
    ASSERT_EQ(messages.texts.size(), 1u);
    EXPECT_EQ(messages.texts[0].substr(0, 23), "/cloud: 3 of 6 splats h");
}

TEST(Tidy, ClampsOpacitiesAndMakesScalesPositive) {
    SplatCloud cloud;
    cloud.positions.resize(4);
    cloud.opacities = {-3.f, 0.25f, 4.f, 1.f};
    cloud.scales = {{-1, 2, -3}, {0, 0, 0}, {1, 1, 1}, {1, 1, 1}};
    Messages messages;
    cloud.name = "/cloud";
    tidySplats(cloud, messages.options().messages);
    EXPECT_EQ(cloud.opacities, (std::vector<float>{0.f, 0.25f, 1.f, 1.f}));
    EXPECT_EQ(cloud.scales[0], glm::vec3(1, 2, 3));
    EXPECT_EQ(messages.texts, std::vector<std::string>{
                                  "/cloud: 2 of 4 splats have an opacity outside 0..1, which is clamped"});
}

TEST(Tidy, TakesEmptyArrays) {
    SplatCloud cloud;
    cloud.positions = {{0, 0, 0}, {NAN, 0, 0}, {1, 0, 0}};
    tidySplats(cloud, {});
    EXPECT_EQ(cloud.positions, (std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}}));
    SplatCloud nothing;
    tidySplats(nothing, {});
    EXPECT_EQ(nothing.size(), 0u);
}

} // namespace
} // namespace hipr::test
