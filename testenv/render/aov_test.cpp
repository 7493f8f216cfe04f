// AOVs of two quads against their closed forms.
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Size = 32;

/// A quad at z = 0 that fills the left half, one at z = -2 that fills the right half but for the bottom
/// quarter.
struct TwoQuads {
    explicit TwoQuads(const CameraDesc& camera)
        : stage([] {
              Settings settings;
              settings.samples = 4;
              settings.pixelFilter = "box";
              return settings;
          }()) {
        left = stage.add(quadMesh({{"st", Interpolation::Vertex, 2, {0, 0, 1, 0, 1, 1, 0, 1}},
                                   {"tag", Interpolation::Constant, 3, {7, 8, 9}}}),
                         matte({0.25f, 0.5f, 0.75f}), {placed(-1, 0, 0, 2, 4)});
        right = stage.add(quadMesh(), matte({0.5f, 0.5f, 0.5f}),
                          {placed(100, 0, 0, 1, 1), glm::mat4x3(0.f), placed(2, 0.25f, -2, 4, 5.5f)});
        stage.edit.setCamera(camera);
        stage.add(skyLight());
        stage.film(Size, Size,
                   {{AovKind::Color, {}},
                    {AovKind::Albedo, {}},
                    {AovKind::Depth, {}},
                    {AovKind::CameraDepth, {}},
                    {AovKind::Normal, {}},
                    {AovKind::Neye, {}},
                    {AovKind::Peye, {}},
                    {AovKind::PatchCoord, {}},
                    {AovKind::PrimId, {}},
                    {AovKind::InstanceId, {}},
                    {AovKind::ElementId, {}},
                    {AovKind::SampleCount, {}},
                    {AovKind::Primvar, "st"},
                    {AovKind::Primvar, "tag"},
                    {AovKind::Primvar, "absent"}});
        stage.render();
    }
    static glm::mat4x3 placed(float x, float y, float z, float sx, float sy) {
        glm::mat4x3 m = scaling(sx, sy, 1);
        m[3] = {x, y, z};
        return m;
    }
    Stage stage;
    ObjectId left{}, right{};
};

/// What the pixel's centre sees, worked out on the host: its world position, and which quad (0, 1; -1: none).
struct Expected {
    glm::dvec3 position;
    int quad;
};

Expected expectedAt(const CameraDesc& camera, uint32_t x, uint32_t y) {
    const glm::dmat4 clipToWorld = glm::inverse(camera.projection * camera.worldToView);
    const glm::dvec2 ndc = 2.0 * (glm::dvec2(x, y) + 0.5) / double(Size) - 1.0;
    glm::dvec4 a = clipToWorld * glm::dvec4(ndc, -1, 1), b = clipToWorld * glm::dvec4(ndc, 0.9, 1);
    a /= a.w, b /= b.w;
    const glm::dvec3 origin(a), d = glm::dvec3(b) - origin;
    const glm::dvec3 front = origin + d * (-origin.z / d.z), back = origin + d * ((-2 - origin.z) / d.z);
    if (front.x > -2 && front.x < 0 && std::abs(front.y) < 2) return {front, 0};
    if (back.x > 0 && back.x < 4 && back.y > -2.5 && back.y < 3) return {back, 1};
    return {{}, -1};
}

void check(const CameraDesc& camera) {
    TwoQuads scene(camera);
    Stage& stage = scene.stage;
    const auto depth = stage.read<float>(AovKind::Depth),
               cameraDepth = stage.read<float>(AovKind::CameraDepth);
    const auto normal = stage.read<glm::vec3>(AovKind::Normal), neye = stage.read<glm::vec3>(AovKind::Neye);
    const auto peye = stage.read<glm::vec3>(AovKind::Peye),
               patch = stage.read<glm::vec3>(AovKind::PatchCoord);
    const auto prim = stage.read<int>(AovKind::PrimId), instance = stage.read<int>(AovKind::InstanceId);
    const auto element = stage.read<int>(AovKind::ElementId), count = stage.read<int>(AovKind::SampleCount);
    const auto albedo = stage.read<glm::vec3>(AovKind::Albedo),
               st = stage.read<glm::vec3>(AovKind::Primvar, "st");
    const auto tag = stage.read<glm::vec3>(AovKind::Primvar, "tag");
    const auto absent = stage.read<glm::vec3>(AovKind::Primvar, "absent");
    int seen[3] = {};
    for (uint32_t y = 0; y < Size; ++y)
        for (uint32_t x = 0; x < Size; ++x) {
            SCOPED_TRACE(testing::Message() << "pixel " << x << ", " << y);
            const Expected expected = expectedAt(camera, x, y);
            ++seen[expected.quad + 1];
            const glm::dvec4 view = camera.worldToView * glm::dvec4(expected.position, 1);
            const glm::dvec4 clip = camera.projection * view;
            const bool hit = expected.quad >= 0;
            ASSERT_NEAR(depth.at(x, y), hit ? 0.5 + 0.5 * clip.z / clip.w : 1, 1e-5);
            ASSERT_NEAR(cameraDepth.at(x, y), hit ? -view.z : 0, 1e-4);
            const glm::vec3 front = hit ? glm::vec3(0, 0, 1) : glm::vec3(0);
            ASSERT_LT(glm::length(normal.at(x, y) - front), 1e-5);
            ASSERT_LT(glm::length(neye.at(x, y) - glm::vec3(glm::dmat3(camera.worldToView) * front)), 1e-5);
            ASSERT_LT(glm::length(glm::dvec3(peye.at(x, y)) - (hit ? glm::dvec3(view) : glm::dvec3(0))),
                      1e-4);
            const glm::dvec3 parts = glm::dvec3(patch.at(x, y));
            ASSERT_EQ(parts == glm::dvec3(0), !hit);
            if (expected.quad == 0) { // corners (0, 1, 2) and (0, 2, 3) of the square
                const glm::dvec2 st((expected.position.x + 2) / 2, (expected.position.y + 2) / 4);
                const glm::dvec2 uv =
                    st.x > st.y ? glm::dvec2(st.x - st.y, st.y) : glm::dvec2(st.x, st.y - st.x);
                ASSERT_LT(glm::length(glm::dvec2(parts) - uv), 1e-4);
            }
            ASSERT_EQ(prim.at(x, y), hit ? int(expected.quad ? scene.right : scene.left) : -1);
            ASSERT_EQ(instance.at(x, y), hit ? (expected.quad ? 2 : 0) : -1);
            ASSERT_EQ(element.at(x, y), hit ? 0 : -1);
            ASSERT_EQ(count.at(x, y), 4);
            const glm::vec3 uv = expected.quad == 0 ? glm::vec3((expected.position.x + 2) / 2,
                                                                (expected.position.y + 2) / 4, 0)
                                                    : glm::vec3(0);
            ASSERT_LT(glm::length(st.at(x, y) - uv), 1e-4);
            ASSERT_LT(glm::length(tag.at(x, y) - (expected.quad == 0 ? glm::vec3(7, 8, 9) : glm::vec3(0))),
                      1e-5);
            ASSERT_EQ(absent.at(x, y), glm::vec3(0));
        }
    EXPECT_GT(seen[0], 10);
    EXPECT_GT(seen[1], 100);
    EXPECT_GT(seen[2], 100);
    EXPECT_LT(glm::length(albedo.at(Size / 4, Size / 2) - glm::vec3(0.25f, 0.5f, 0.75f)), 1e-3);
    ASSERT_EQ(stage.messages().size(), 1u); // the flat instance
    EXPECT_EQ(stage.messages()[0].subject, "/object" + std::to_string(uint32_t(scene.right)));
}

} // namespace

TEST(Aov, TwoQuadsInPerspective) {
    check(lookAt({0.1, 0.2, 5}, {0, 0, 0}));
}

TEST(Aov, TwoQuadsFromTheSide) {
    check(lookAt({1, 1.2, 6}, {0.2, 0, -0.5}, 35));
}

TEST(Aov, TwoQuadsInParallelProjection) {
    check({glm::lookAt(glm::dvec3(0.3, 0.4, 5), glm::dvec3(0), glm::dvec3(0, 1, 0)),
           glm::ortho(-2.2, 2.4, -3.0, 2.5, 0.5, 40.0)});
}

TEST(Aov, ClippingPlanesCutSight) {
    CameraDesc camera = lookAt({0.1, 0.2, 5}, {0, 0, 0});
    camera.projection = glm::perspective(glm::radians(40.0), 1.0, 5.5, 100.0); // cuts the front quad
    TwoQuads scene(camera);
    const auto prim = scene.stage.read<int>(AovKind::PrimId);
    for (int id : prim.values)
        EXPECT_NE(id, int(scene.left));
    EXPECT_EQ(prim.at(3 * Size / 4, Size / 2), int(scene.right));
}

TEST(Aov, UnknownRequestsAndSizesAreRefused) {
    TwoQuads scene(lookAt({0, 0, 5}, {0, 0, 0}));
    std::vector<float> values(Size * Size * 4);
    EXPECT_TRUE(scene.stage.renderer->readAov({AovKind::Color, {}}, values.data(), values.size()));
    EXPECT_FALSE(scene.stage.renderer->readAov({AovKind::Color, {}}, values.data(), values.size() - 1));
    EXPECT_FALSE(scene.stage.renderer->readAov({AovKind::Primvar, "other"}, values.data(), Size * Size * 3));
}

TEST(Aov, CutOutSurfacesAreNotSeen) {
    Stage stage;
    MaterialDesc cut = matte(glm::vec3(0.5f));
    cut.opacity = constantValue(0.2f);
    cut.opacityThreshold = constantValue(0.5f);
    stage.add(quadMesh(), cut, {scaling(50, 50, 1)});
    const ObjectId behind =
        stage.add(quadMesh(), matte(glm::vec3(0.5f)), {TwoQuads::placed(0, 0, -2, 50, 50)});
    stage.edit.setCamera(lookAt({0, 0, 5}, {0, 0, 0}));
    stage.film(8, 8, {{AovKind::PrimId, {}}});
    stage.render();
    for (int id : stage.read<int>(AovKind::PrimId).values)
        EXPECT_EQ(id, int(behind));
}
