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
    explicit Ball(glm::mat4x3 transform = glm::mat4x3(1.f)) : Stage(few()) {
        ball = add(sphereMesh(16), matte(glm::vec3(0.5f)), {transform});
        edit.setCamera(view());
        film(Side, Side, {{AovKind::Color, {}}, {AovKind::CameraDepth, {}}, {AovKind::PrimId, {}}});
        LightDesc sky;
        sky.kind = LightKind::Dome;
        Stage::add(sky);
    }
    static Settings few() {
        Settings settings;
        settings.samples = 16;
        return settings;
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

/// As cards of UsdImaging are: a ray that passed one of the faces would miss the other.
TEST(Culling, LeavesFacesBackToBackAlone) {
    auto both = std::make_shared<TriangleMesh>(*quadMesh());
    const std::vector<glm::vec3> front = both->positions;
    both->positions.insert(both->positions.end(), front.begin(), front.end());
    both->triangles.insert(both->triangles.end(), {{5, 4, 7}, {7, 6, 5}});
    both->triangleFace.insert(both->triangleFace.end(), {1, 1});
    Stage stage(Ball::few());
    stage.add(both, matte(glm::vec3(0.5f)), {scaling(9, 9, 1)});
    stage.edit.setCamera(Ball::view(CullStyle::Back));
    stage.film(Side, Side);
    stage.render();
    EXPECT_EQ(mean(stage.color()).w, 1.f);
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
