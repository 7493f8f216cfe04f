// Faces that the camera does not see, and light does.
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr uint32_t Side = 16;

/// A ball of radius 1 in front of a wall, lit by a white sky; seen from +z.
class Ball : public Stage {
public:
    explicit Ball(glm::mat4x3 transform = glm::mat4x3(1.f)) : Stage(withSamples(16)) {
        ball = add(sphereMesh(16), matte(glm::vec3(0.5f)), {transform});
        edit.setCamera(view());
        film(Side, Side, {{AovKind::Color, {}}, {AovKind::CameraDepth, {}}, {AovKind::PrimId, {}}});
        Stage::add(skyLight());
    }
    static CameraDesc view(CullStyle cull = CullStyle::Nothing) {
        CameraDesc camera = lookAt({0, 0, 4}, {0, 0, 0}, 40);
        camera.cull = cull;
        return camera;
    }
    /// Of what is seen in the middle of the picture, 0: nothing.
    float depth() {
        render();
        return read<float>(AovKind::CameraDepth).at(Side / 2, Side / 2);
    }
    ObjectId ball;
};

constexpr float Near = 3.f, Far = 5.f, Rough = 0.1f;

} // namespace

TEST(Culling, ShowsWhatIsBehind) {
    Ball stage;
    EXPECT_NEAR(stage.depth(), Near, Rough);
    stage.edit.setCamera(Ball::view(CullStyle::Front));
    EXPECT_NEAR(stage.depth(), Far, Rough);
    stage.edit.setCamera(Ball::view(CullStyle::Back));
    EXPECT_NEAR(stage.depth(), Near, Rough);
    Ball mirrored(scaling(-1, 1, 1)); // a transform that turns it inside out does not turn its faces over
    mirrored.edit.setCamera(Ball::view(CullStyle::Back));
    EXPECT_NEAR(mirrored.depth(), Near, Rough);
}

/// Inside of a closed ball it is dark, whatever the camera sees through.
TEST(Culling, IsNotForLight) {
    Ball stage;
    stage.edit.setCamera(Ball::view(CullStyle::Front));
    stage.render();
    EXPECT_EQ(stage.color().at(Side / 2, Side / 2), glm::vec4(0, 0, 0, 1));
}

namespace {

/// Two squares at one place, of which the first faces +z and the second -z. Their diagonals differ.
std::shared_ptr<TriangleMesh> backToBack() {
    auto both = std::make_shared<TriangleMesh>(*quadMesh());
    const std::vector<glm::vec3> front = both->positions;
    both->positions.insert(both->positions.end(), front.begin(), front.end());
    both->triangles.insert(both->triangles.end(), {{5, 4, 7}, {7, 6, 5}});
    both->triangleFace.insert(both->triangleFace.end(), {1, 1});
    return both;
}

void expectTheSideThatIsLeft(std::shared_ptr<const TriangleMesh> mesh, Shutter shutter) {
    for (const CullStyle cull : {CullStyle::Back, CullStyle::Front, CullStyle::BackAndForLight})
        for (const bool fromFront : {true, false}) {
            Stage stage(withSamples(16));
            stage.add(mesh, matte(glm::vec3(0.5f)), {scaling(9, 9, 1)});
            CameraDesc camera = lookAt({0, 0, fromFront ? 4 : -4}, {0, 0, 0}, 40);
            camera.cull = cull;
            camera.shutter = shutter;
            stage.edit.setCamera(camera);
            stage.film(Side, Side, {{AovKind::Color, {}}, {AovKind::ElementId, {}}});
            stage.render();
            EXPECT_EQ(mean(stage.color()).w, 1.f);
            EXPECT_EQ(stage.read<int>(AovKind::ElementId).at(Side / 2, Side / 3),
                      fromFront == (cull != CullStyle::Front) ? 0 : 1);
        }
}

} // namespace

TEST(Culling, OfFacesBackToBackLeavesOne) {
    expectTheSideThatIsLeft(backToBack(), {});
}

TEST(Culling, OfFacesBackToBackThatMoveLeavesOne) {
    const std::shared_ptr<const TriangleMesh> before = backToBack();
    auto after = std::make_shared<TriangleMesh>(*before);
    for (glm::vec3& p : after->positions)
        p += glm::vec3(0.01f, 0.f, 0.3f * p.x);
    const auto moving = withMotion(*before, {{0.f, before}, {1.f, after}});
    ASSERT_TRUE(moving);
    expectTheSideThatIsLeft(moving, {0.f, 1.f});
}

/// A red square faces the camera, and a green one at its place the mirror behind it.
TEST(Culling, ForLightToo) {
    Stage stage(withSamples(16));
    stage.add(quadMesh(), matte({0.8f, 0.f, 0.f}));
    stage.add(quadMesh(), matte({0.f, 0.8f, 0.f}), {scaling(-1, 1, -1)});
    stage.add(quadMesh(), mirror(), {placed(scaling(9, 9, 1), 0, 0, -2)});
    stage.add(skyLight());
    CameraDesc camera = lookAt({3, 0, 4}, {0, 0, -4}, 4); // at the picture in the mirror
    camera.cull = CullStyle::BackAndForLight;
    stage.edit.setCamera(camera);
    stage.film(Side, Side);
    stage.render();
    const glm::vec4 reflected = stage.color().at(Side / 2, Side / 2);
    EXPECT_GT(reflected.y, 0.1f);
    EXPECT_LT(reflected.x, 0.01f * reflected.y); // mirrors are never quite smooth
}

TEST(Culling, EditedIsAsFresh) {
    Ball edited;
    edited.render();
    edited.edit.setCamera(Ball::view(CullStyle::FrontUnlessDoubleSided));
    edited.render();
    Ball fresh;
    fresh.edit.setCamera(Ball::view(CullStyle::FrontUnlessDoubleSided));
    fresh.render();
    EXPECT_TRUE(sameBits(edited.color(), fresh.color()));
    edited.edit.setCamera(Ball::view());
    edited.render();
    Ball whole;
    whole.render();
    EXPECT_TRUE(sameBits(edited.color(), whole.color()));
}
