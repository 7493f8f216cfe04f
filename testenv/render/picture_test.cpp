// Pictures whose values are known: white furnaces, AOVs of flat shapes, the camera light.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

/// Straight along -z; a surface that faces it shows its own colour.
LightDesc sun() {
    LightDesc light;
    light.name = "/sun";
    light.kind = LightKind::Distant;
    light.normalize = true;
    light.angle = 0.f;
    light.intensity = glm::pi<float>();
    return light;
}

} // namespace

TEST(Picture, QuadAndSphereUnderARectLight) {
    Settings settings;
    settings.samples = 64;
    Stage stage(settings);
    stage.add(quadMesh(), matte({0.7f, 0.7f, 0.7f}),
              {glm::mat4x3({8, 0, 0}, {0, 0, -8}, {0, 8, 0}, {0, -1, 0})});
    MaterialDesc plastic;
    plastic.diffuseColor = constantColor({0.8f, 0.2f, 0.1f});
    plastic.roughness = constantValue(0.2f);
    stage.add(sphereMesh(), plastic);
    stage.add(lampAbove({2, 4, 2}, 2, 10));
    stage.edit.setCamera(lookAt({0, 1.5, 6}, {0, 0, 0}));
    stage.film(256, 256);
    stage.render();
    const ColorPicture picture = stage.color();
    save(picture, "quad_and_sphere");
    // The lit side of the sphere is red, the ground behind it is grey and brighter than its shadow.
    const glm::vec4 lit = picture.at(138, 170), ground = picture.at(200, 60);
    EXPECT_GT(lit.x, 2 * lit.y);
    EXPECT_NEAR(ground.x, ground.y, 0.15f * ground.x);
    EXPECT_GT(ground.x, 0.05f);
    EXPECT_EQ(picture.at(128, 255).w, 0.f);
    EXPECT_EQ(picture.at(128, 128).w, 1.f);
}

// An open white box in a white sky: however often light bounces about in it, it looks as bright as the sky.
TEST(Picture, WhiteBoxFurnace) {
    Settings settings;
    settings.samples = 128;
    settings.maxDepth = 1024;
    Stage stage(settings);
    const float h = 0.5f;
    stage.add(quadMesh(), matte(glm::vec3(1.f)),
              {glm::mat4x3({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -h}), // back
               glm::mat4x3({0, 0, 1}, {0, 1, 0}, {-1, 0, 0}, {h, 0, 0}), // sides
               glm::mat4x3({0, 0, -1}, {0, 1, 0}, {1, 0, 0}, {-h, 0, 0}),
               glm::mat4x3({1, 0, 0}, {0, 0, 1}, {0, -1, 0}, {0, h, 0}), // top
               glm::mat4x3({1, 0, 0}, {0, 0, -1}, {0, 1, 0}, {0, -h, 0})});
    stage.add(skyLight());
    stage.edit.setCamera(lookAt({0.3, 0.2, 2.2}, {0, 0, -h}, 30));
    stage.film(32, 32);
    stage.render();
    const ColorPicture picture = stage.color();
    save(picture, "white_box");
    EXPECT_NEAR(mean(picture).x, 1.f, 0.005f);
    EXPECT_EQ(picture.at(16, 16).w, 1.f);
}

// A white object in a white sky cannot be seen.
TEST(Picture, WhiteFurnace) {
    Settings settings;
    settings.samples = 256;
    settings.maxDepth = 64;
    for (int kind = 0; kind < 3; ++kind) {
        Stage stage(settings);
        MaterialDesc material = matte(glm::vec3(1.f));
        if (kind == 1)
            material.specularColor = constantColor(glm::vec3(0.3f)), material.roughness = constantValue(0.4f);
        if (kind == 2) material.metallic = constantValue(1.f), material.useSpecularWorkflow = false;
        stage.add(sphereMesh(), material);
        stage.add(skyLight());
        stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
        stage.film(32, 32);
        stage.render();
        const glm::vec4 value = mean(stage.color());
        // A rough metal is a single-scattering lobe and may lose a little; nothing may gain.
        EXPECT_NEAR(value.x, 1.f, kind == 2 ? 0.06f : 0.01f) << kind;
        EXPECT_LT(value.x, 1.01f) << kind;
    }
}

TEST(Picture, RouletteAndDepthKeepTheMean) {
    glm::vec4 means[2];
    for (int i = 0; i < 2; ++i) {
        Settings settings;
        settings.samples = 128;
        settings.maxDepth = 32;
        settings.rouletteDepth = i == 0 ? 1 : 1024;
        Stage stage(settings);
        MaterialDesc glow = matte(glm::vec3(0.6f, 0.3f, 0.1f));
        glow.emissiveColor = constantColor(glm::vec3(1.f));
        stage.add(sphereMesh(), glow);
        stage.edit.setCamera(lookAt({0, 0, 0.2}, {0, 0, -1}));
        stage.add(skyLight(0.f));
        stage.film(16, 16);
        stage.render();
        means[i] = mean(stage.color());
    }
    EXPECT_NEAR(means[0].x, means[1].x, 0.01f * means[1].x);
    EXPECT_NEAR(means[0].y, means[1].y, 0.01f * means[1].y);
}

// One bounce: a plane under a dome has radiance albedo * L whatever the direction.
TEST(Picture, DirectLightOnlyAtDepthOne) {
    Settings settings;
    settings.samples = 64;
    settings.maxDepth = 1;
    Stage stage(settings);
    stage.add(quadMesh(), matte(glm::vec3(0.25f)), {scaling(10, 10, 1)});
    stage.add(skyLight(2.f));
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.film(16, 16);
    stage.render();
    EXPECT_NEAR(mean(stage.color()).y, 0.5f, 0.005f);
}

// A light of the scene is found by two weighted techniques, glowing geometry by one alone: both must agree.
TEST(Picture, LightsEqualGlowingShapes) {
    Settings settings;
    settings.maxDepth = 1;
    const glm::dmat4 above = glm::translate(glm::dmat4(1), glm::dvec3(0.3, 0.2, 1.5));
    for (LightKind kind : {LightKind::Rect, LightKind::Sphere})
        for (float roughness : {0.15f, 0.6f}) {
            glm::vec4 means[2];
            for (int glowing = 0; glowing < 2; ++glowing) {
                settings.samples = glowing ? 512 : 64;
                Stage stage(settings);
                MaterialDesc metal;
                metal.diffuseColor = constantColor(glm::vec3(0.8f));
                metal.metallic = constantValue(0.5f);
                metal.roughness = constantValue(roughness);
                stage.add(quadMesh(), metal, {scaling(8, 8, 1)});
                MaterialDesc glow = matte(glm::vec3(0.f));
                glow.emissiveColor = constantColor(glm::vec3(3.f));
                LightDesc light;
                light.kind = kind;
                light.transform = above;
                light.width = light.height = 2.f;
                light.radius = 0.7f;
                light.intensity = 3.f;
                if (!glowing)
                    stage.add(light);
                else if (kind == LightKind::Rect)
                    stage.add(quadMesh(), glow,
                              {glm::mat4x3(above * glm::scale(glm::dmat4(1), glm::dvec3(2, 2, 1)))});
                else
                    stage.add(sphereMesh(96), glow,
                              {glm::mat4x3(above * glm::scale(glm::dmat4(1), glm::dvec3(0.7)))});
                if (glowing) stage.add(skyLight(0.f));
                // From the side, below the light: only the lit plane is seen.
                stage.edit.setCamera(lookAt({-4, 0, 1.2}, {0.2, 0, 0}, 15));
                stage.film(32, 32);
                stage.render();
                means[glowing] = mean(stage.color());
                EXPECT_EQ(stage.color().at(16, 31).w, 1.f);
            }
            EXPECT_GT(means[0].x, 0.05f);
            EXPECT_NEAR(means[0].x, means[1].x, 0.015f * means[1].x) << int(kind) << " " << roughness;
        }
}

TEST(Picture, PresenceLetsLightAndSightThrough) {
    Settings settings;
    settings.samples = 256;
    Stage stage(settings);
    stage.add(quadMesh(), matte(glm::vec3(0.5f)), {scaling(20, 20, 1)});
    MaterialDesc veil = matte(glm::vec3(0.f));
    veil.opacity = constantValue(0.25f);
    veil.opacityMode = OpacityMode::Presence;
    stage.add(quadMesh(), veil, {[] {
                  auto m = scaling(200, 200, 1);
                  m[3].z = 1.f;
                  return m;
              }()});
    stage.add(sun());
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.film(16, 16);
    stage.render();
    EXPECT_NEAR(mean(stage.color()).y, 0.5f * 0.75f * 0.75f, 0.01f); // sunlight and view cross the black veil
}

TEST(Picture, ManyVeils) {
    Settings settings;
    settings.samples = 4;
    Stage stage(settings, {16, 1 << 16});
    stage.add(quadMesh(), matte(glm::vec3(0.5f)), {scaling(20, 20, 1)});
    MaterialDesc veil = matte(glm::vec3(0.f));
    veil.opacity = constantValue(0.02f);
    veil.opacityMode = OpacityMode::Presence;
    std::vector<glm::mat4x3> layers(40, scaling(200, 200, 1));
    for (size_t i = 0; i < layers.size(); ++i)
        layers[i][3].z = 0.02f * float(i + 1);
    stage.add(quadMesh(), veil, layers);
    stage.add(sun());
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.film(64, 64);
    stage.render();
    const float expected = 0.5f * float(std::pow(0.98, 80.0));
    EXPECT_NEAR(mean(stage.color()).y, expected, 0.03f * expected);
}

TEST(Picture, ManySamplesSumExactly) {
    Settings settings;
    settings.samples = 300000;
    Stage stage(settings);
    stage.add(skyLight(0.1f));
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.film(2, 2);
    stage.render();
    EXPECT_NEAR(stage.color().at(1, 1).x, 0.1f, 1e-7f);
}

TEST(Picture, CameraLightWhenThereIsNone) {
    Settings settings;
    settings.samples = 64;
    Stage stage(settings);
    stage.add(quadMesh(), matte(glm::vec3(0.5f)), {scaling(10, 10, 1)});
    stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
    stage.film(16, 16);
    stage.render();
    EXPECT_NEAR(mean(stage.color()).y, 0.5f, 0.01f);
    ASSERT_EQ(stage.messages().size(), 1u);
    EXPECT_EQ(stage.messages()[0].severity, Severity::Info);

    LightDesc light = skyLight(0.5f); // switched off, it leaves the scene dark on purpose
    light.visible = false;
    const LightId id = stage.add(light);
    stage.render();
    EXPECT_EQ(mean(stage.color()).y, 0.f);
    light.visible = true;
    stage.edit.setLight(id, light);
    stage.render();
    EXPECT_NEAR(mean(stage.color()).y, 0.25f, 0.01f);
    settings.enableSceneLights = false;
    stage.settings(settings);
    stage.render();
    EXPECT_NEAR(mean(stage.color()).y, 0.5f, 0.01f);
    EXPECT_EQ(stage.messages().size(), 1u);
}

TEST(Picture, FireflyClampOnlyTouchesIndirectLight) {
    glm::vec4 means[2];
    for (int i = 0; i < 2; ++i) {
        Settings settings;
        settings.samples = 64;
        settings.fireflyClamp = i ? 1e-6f : 0.f;
        Stage stage(settings);
        stage.add(sphereMesh(), matte(glm::vec3(0.8f)));
        stage.add(quadMesh(), matte(glm::vec3(0.8f)), {[] {
                      auto m = scaling(9, 9, 1);
                      m[3].z = -1.f;
                      return m;
                  }()});
        stage.add(skyLight());
        stage.edit.setCamera(lookAt({0, 0, 4}, {0, 0, 0}));
        stage.film(16, 16);
        stage.render();
        means[i] = mean(stage.color());
    }
    EXPECT_LT(means[1].y, 0.98f * means[0].y);
    EXPECT_GT(means[1].y, 0.5f * means[0].y);
}
