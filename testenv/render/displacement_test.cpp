// Displaced geometry through edits: whatever came in whatever order, the picture is that of a fresh scene.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr GeometryId ball{1};
constexpr MaterialId grey{2}, red{3};
constexpr ObjectId object{4};
constexpr LightId sky{5};

MaterialDesc displacing(float height, glm::vec3 color = glm::vec3(0.6f)) {
    MaterialDesc material = matte(color);
    material.displacement.amount.constant = glm::vec4(height);
    return material;
}

/// What the scene holds after an edit.
struct Scene {
    std::shared_ptr<const TriangleMesh> mesh = sphereMesh(12);
    MaterialDesc grey = matte(glm::vec3(0.6f)), red = displacing(0.4f, {0.8f, 0.1f, 0.1f});
    MaterialId bound = ::grey;
    bool there = true, hasRed = true, materials = true;

    void fill(SceneEdit& edit) const {
        if (there) {
            edit.setGeometry(ball, mesh);
            edit.setObject(object, desc());
        }
        edit.setMaterial(::grey, grey);
        if (hasRed) edit.setMaterial(::red, red);
        LightDesc dome;
        dome.kind = LightKind::Dome;
        edit.setLight(sky, dome);
        edit.setCamera(lookAt({0, 1, 6}, {0, 0, 0}));
    }
    ObjectDesc desc() const { return {"/ball", ball, {bound}, true, 0}; }
    Settings settings() const {
        Settings settings;
        settings.samples = 2;
        settings.enableSceneMaterials = materials;
        return settings;
    }
};

ColorPicture fresh(const Scene& scene) {
    Stage stage(scene.settings());
    scene.fill(stage.edit);
    stage.film(32, 32);
    stage.render();
    return stage.color();
}

struct Step {
    const char* name;
    std::function<void(Scene&, SceneEdit&)> apply;
    bool shows = true;
};

const std::vector<Step>& steps() {
    static const std::vector<Step> steps = {
        {"bound",
         [](Scene& s, SceneEdit& e) {
             s.bound = red;
             e.setObject(object, s.desc());
         }},
        {"further out",
         [](Scene& s, SceneEdit& e) {
             s.red = displacing(0.7f, {0.8f, 0.1f, 0.1f});
             e.setMaterial(red, s.red);
         }},
        {"new points",
         [](Scene& s, SceneEdit& e) {
             s.mesh = sphereMesh(7);
             e.setGeometry(ball, s.mesh);
         }},
        {"new points and height in one edit, the height last",
         [](Scene& s, SceneEdit& e) {
             s.mesh = sphereMesh(9);
             s.red = displacing(0.3f, {0.8f, 0.1f, 0.1f});
             e.setGeometry(ball, s.mesh);
             e.setMaterial(red, s.red);
         }},
        {"settings without materials", [](Scene& s, SceneEdit&) { s.materials = false; }},
        {"settings with materials", [](Scene& s, SceneEdit&) { s.materials = true; }},
        {"along the surface only",
         [](Scene& s, SceneEdit& e) {
             s.red.displacement.vector = true;
             s.red.displacement.amount.constant = glm::vec4(0.3f, -0.2f, 0.1f, 0.f);
             e.setMaterial(red, s.red);
         }},
        {"material gone",
         [](Scene& s, SceneEdit& e) {
             s.hasRed = false;
             e.removeMaterial(red);
         }},
        {"material back",
         [](Scene& s, SceneEdit& e) {
             s.hasRed = true;
             e.setMaterial(red, s.red);
         }},
        {"object gone",
         [](Scene& s, SceneEdit& e) {
             s.there = false;
             e.removeObject(object);
             e.removeGeometry(ball);
         }},
        {"object back",
         [](Scene& s, SceneEdit& e) {
             s.there = true;
             e.setObject(object, s.desc());
             e.setGeometry(ball, s.mesh);
         }},
        {"the same again",
         [](Scene& s, SceneEdit& e) {
             e.setGeometry(ball, std::make_shared<TriangleMesh>(*s.mesh));
             e.setMaterial(red, s.red);
         },
         false},
        {"of another material",
         [](Scene& s, SceneEdit& e) {
             s.bound = grey;
             e.setObject(object, s.desc());
         }},
    };
    return steps;
}

TEST(Displacement, EditsGiveThePictureOfAFreshScene) {
    Scene scene;
    Stage stage(scene.settings());
    stage.film(32, 32);
    scene.fill(stage.edit);
    stage.render();
    ColorPicture last = stage.color();
    EXPECT_TRUE(sameBits(last, fresh(scene)));
    for (const Step& step : steps()) {
        SCOPED_TRACE(step.name);
        step.apply(scene, stage.edit);
        stage.settings(scene.settings());
        stage.render();
        const ColorPicture now = stage.color();
        EXPECT_TRUE(sameBits(now, fresh(scene)));
        EXPECT_EQ(!sameBits(now, last), step.shows);
        last = now;
    }
    EXPECT_TRUE(stage.messages().empty());
}

/// A ball that is pushed out is the larger ball.
TEST(Displacement, ABallPushedOutIsALargerBall) {
    Scene pushed, larger;
    pushed.bound = red;
    larger.bound = red;
    larger.red = matte({0.8f, 0.1f, 0.1f});
    auto mesh = std::make_shared<TriangleMesh>(*larger.mesh);
    for (glm::vec3& p : mesh->positions)
        p *= 1.4f;
    mesh->boundsMin *= 1.4f;
    mesh->boundsMax *= 1.4f;
    larger.mesh = mesh;
    const ColorPicture a = fresh(pushed), b = fresh(larger);
    double difference = 0.0;
    for (size_t i = 0; i < a.values.size(); ++i)
        difference += glm::length(glm::vec3(a.values[i] - b.values[i]));
    EXPECT_LT(difference / double(a.values.size()), 1e-3);
    EXPECT_FALSE(sameBits(a, fresh(Scene())));
}

} // namespace
