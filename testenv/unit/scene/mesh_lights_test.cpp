// How light samples spread over the triangles of an emissive mesh.
#include "renderer/scene/mesh_lights.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace hipr::test {
namespace {

/// Triangles of areas 0.5, 2 and 0 in the xy plane, and one of area 1 across it; slots 0, 1, 0, 2.
TriangleMesh someTriangles() {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 1, 3}, {0, 3, 5}};
    mesh.triangleSlot = {0, 1, 0, 2};
    return mesh;
}

TEST(TriangleSpread, ChancesGoByAreaAndLuminance) {
    const TriangleSpread spread = spreadOverTriangles(someTriangles(), {4.f, 3.f, 0.f});
    EXPECT_EQ(spread.weight, 0.5 * 4.0 + 2.0 * 3.0);
    EXPECT_EQ(spread.sums, (std::vector<float>{0.f, 0.25f, 1.f, 1.f, 1.f}));
    EXPECT_EQ(spread.box.min, glm::vec3(0, 0, 0));
    EXPECT_EQ(spread.box.max, glm::vec3(2, 2, 0));
    // A slot without a material emits nothing.
    EXPECT_EQ(spreadOverTriangles(someTriangles(), {4.f}).sums,
              (std::vector<float>{0.f, 1.f, 1.f, 1.f, 1.f}));
    EXPECT_EQ(spreadOverTriangles(someTriangles(), {0.f, 0.f, 1.f}).sums,
              (std::vector<float>{0.f, 0.f, 0.f, 0.f, 1.f}));
}

TEST(TriangleSpread, NothingEmits) {
    EXPECT_EQ(spreadOverTriangles(someTriangles(), {}).weight, 0.0);
    EXPECT_EQ(spreadOverTriangles(someTriangles(), {0.f, 0.f, 0.f}).weight, 0.0);
    EXPECT_TRUE(spreadOverTriangles(someTriangles(), {0.f}).sums.empty());
    TriangleMesh flat = someTriangles();
    flat.positions.assign(flat.positions.size(), glm::vec3(1.f));
    EXPECT_EQ(spreadOverTriangles(flat, {1.f, 1.f, 1.f}).weight, 0.0);
}

TEST(TriangleSpread, OfScaledInstances) {
    const auto scaled = [](float x, float y, float z) {
        return glm::mat4x3(glm::scale(glm::mat4(1), {x, y, z}));
    };
    const TriangleSpread flat = spreadOverTriangles(someTriangles(), {4.f, 3.f});
    EXPECT_NEAR(flat.worldWeight(scaled(1, 1, 1)), flat.weight, 1e-12);
    EXPECT_NEAR(flat.worldWeight(scaled(2, -5, 1)), 10.0 * flat.weight, 1e-5);
    EXPECT_NEAR(flat.worldWeight(scaled(2, 5, 0.001f)), 10.0 * flat.weight, 1e-5); // flat it stays
    // Not flat: a mean of squares of the two stretches, 4 and 2.
    const TriangleSpread bent = spreadOverTriangles(someTriangles(), {2.f, 0.f, 1.f});
    EXPECT_NEAR(bent.worldWeight(scaled(2, 2, 1)), 2.0 * std::sqrt(0.5 * (16.0 + 4.0)), 1e-5);
}

} // namespace
} // namespace hipr::test
