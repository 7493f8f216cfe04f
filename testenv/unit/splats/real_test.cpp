// A real capture, where the shared assets lie beside the checkout.
#include <filesystem>

#include "splat_kit.h"

namespace hipr::test {
namespace {

TEST(RealCapture, IsReadWhole) {
    const std::string path = HIPR_ASSETS "/splats/playbot/playbot_31k_sh2.ply";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
    Messages messages;
    const SplatCloud cloud = readSplatFile(path, messages.options());
    EXPECT_EQ(messages.texts, std::vector<std::string>());
    EXPECT_EQ(cloud.size(), 31000u);
    EXPECT_EQ(cloud.shDegree, 2u);
    glm::vec3 low(1e9f), high(-1e9f), scale(0.f);
    for (size_t i = 0; i < cloud.size(); ++i) {
        low = glm::min(low, cloud.positions[i]);
        high = glm::max(high, cloud.positions[i]);
        scale = glm::max(scale, cloud.scales[i]);
    }
    // A standing robot about a metre tall, made of small splats.
    EXPECT_GT(high.y - low.y, 0.5f);
    EXPECT_LT(high.y - low.y, 3.f);
    EXPECT_LT(scale.x, 1.f);
}

} // namespace
} // namespace hipr::test
