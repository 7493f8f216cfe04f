// An edited scene renders like a fresh one, reports what changed, and rebuilds no more than that.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

/// Ids are the same in every stage, as they are for an edited and a fresh scene of one host.
struct Ids {
    GeometryId ground{1}, ball{2};
    MaterialId grey{3}, red{4};
    ObjectId floor{5}, balls{6};
    LightId lamp{7}, sky{8};
};
const Ids ids;

/// All that the scene is made of; edits change a copy.
struct Scene {
    std::shared_ptr<const TriangleMesh> ground = quadMesh(), ball = sphereMesh(12);
    MaterialDesc grey = matte(glm::vec3(0.6f)), red;
    ObjectDesc floor{"/floor", ids.ground, {ids.grey}, true, 0},
        balls{"/balls", ids.ball, {ids.red}, true, 1};
    InstancesDesc floorPlace{{glm::mat4x3({9, 0, 0}, {0, 0, -9}, {0, 9, 0}, {0, -1, 0})}, {}, {}};
    InstancesDesc ballPlaces{{translation(-1.2f, 0, 0), translation(1.2f, 0, 0)}, {}, {}};
    LightDesc lamp, sky;
    CameraDesc camera = lookAt({0, 1, 6}, {0, 0, 0});
    bool hasBalls = true, hasSky = true;

    Scene() {
        red.diffuseColor = constantColor({0.8f, 0.2f, 0.1f});
        lamp.kind = LightKind::Disk;
        lamp.intensity = 20.f;
        lamp.transform = glm::translate(glm::dmat4(1), glm::dvec3(0, 4, 0)) *
                         glm::rotate(glm::dmat4(1), -glm::half_pi<double>(), glm::dvec3(1, 0, 0));
        sky.kind = LightKind::Dome;
        sky.intensity = 0.3f;
    }
    void fill(SceneEdit& edit) const {
        edit.setGeometry(ids.ground, ground);
        edit.setMaterial(ids.grey, grey);
        edit.setMaterial(ids.red, red);
        edit.setObject(ids.floor, floor);
        edit.setInstances(ids.floor, floorPlace);
        if (hasBalls) {
            edit.setGeometry(ids.ball, ball);
            edit.setObject(ids.balls, balls);
            edit.setInstances(ids.balls, ballPlaces);
        }
        edit.setLight(ids.lamp, lamp);
        if (hasSky) edit.setLight(ids.sky, sky);
        edit.setCamera(camera);
    }
};

ColorPicture fresh(const Scene& scene) {
    Stage stage(withSamples(4));
    scene.fill(stage.edit);
    stage.film(48, 48);
    stage.render();
    return stage.color();
}

struct Expectation {
    const char* name;
    std::function<void(Scene&, SceneEdit&)> apply;
    Change change;
};

std::vector<Expectation> edits() {
    return {
        {"transform",
         [](Scene& s, SceneEdit& e) {
             s.ballPlaces.transforms[1] = translation(0.8f, 0.5f, 0.3f);
             e.setInstances(ids.balls, s.ballPlaces);
         },
         Change::Transform},
        {"instance count",
         [](Scene& s, SceneEdit& e) {
             s.ballPlaces.transforms.push_back(translation(0, 1.5f, -1));
             e.setInstances(ids.balls, s.ballPlaces);
         },
         Change::Added},
        {"earlier object shrinks",
         [](Scene& s, SceneEdit& e) {
             s.floorPlace.transforms.clear();
             e.setInstances(ids.floor, s.floorPlace);
         },
         Change::Removed},
        {"material",
         [](Scene& s, SceneEdit& e) {
             s.red.diffuseColor = constantColor({0.1f, 0.2f, 0.9f});
             e.setMaterial(ids.red, s.red);
         },
         Change::Material},
        {"presence",
         [](Scene& s, SceneEdit& e) {
             s.red.opacity = constantValue(0.5f);
             s.red.opacityMode = OpacityMode::Presence;
             e.setMaterial(ids.red, s.red);
         },
         Change::Material},
        {"binding",
         [](Scene& s, SceneEdit& e) {
             s.balls.materials = {ids.grey};
             e.setObject(ids.balls, s.balls);
         },
         Change::Material},
        {"light",
         [](Scene& s, SceneEdit& e) {
             s.lamp.intensity = 5.f;
             e.setLight(ids.lamp, s.lamp);
         },
         Change::Emission},
        {"light removed",
         [](Scene& s, SceneEdit& e) {
             s.hasSky = false;
             e.removeLight(ids.sky);
         },
         Change::Removed},
        {"visibility",
         [](Scene& s, SceneEdit& e) {
             s.balls.visible = false;
             e.setObject(ids.balls, s.balls);
         },
         Change::Visibility},
        {"removal",
         [](Scene& s, SceneEdit& e) {
             s.hasBalls = false;
             e.removeObject(ids.balls);
             e.removeGeometry(ids.ball);
         },
         Change::Removed},
        {"points",
         [](Scene& s, SceneEdit& e) {
             auto mesh = std::make_shared<TriangleMesh>(*s.ball);
             for (glm::vec3& p : mesh->positions)
                 p.y *= 1.3f;
             mesh->boundsMax.y = 1.3f, mesh->boundsMin.y = -1.3f;
             s.ball = mesh;
             e.setGeometry(ids.ball, s.ball);
         },
         Change::Geometry},
        {"topology",
         [](Scene& s, SceneEdit& e) {
             s.ball = sphereMesh(5);
             e.setGeometry(ids.ball, s.ball);
         },
         Change::Geometry},
        {"camera",
         [](Scene& s, SceneEdit& e) {
             s.camera = lookAt({1, 2, 5}, {0, 0, 0});
             e.setCamera(s.camera);
         },
         Change::Camera},
    };
}

} // namespace

TEST(Edit, EditedEqualsFresh) {
    const Scene before;
    const ColorPicture unedited = fresh(before);
    for (const Expectation& expectation : edits()) {
        SCOPED_TRACE(expectation.name);
        Stage stage(withSamples(4));
        before.fill(stage.edit);
        stage.film(48, 48);
        stage.render();
        ASSERT_TRUE(sameBits(stage.color(), unedited));

        Scene after = before;
        expectation.apply(after, stage.edit);
        const ChangedSet changed = stage.renderer->commit(stage.edit);
        ASSERT_FALSE(changed.empty());
        EXPECT_TRUE(changed.elements[0].change & expectation.change);
        stage.render();
        const ColorPicture edited = stage.color();
        EXPECT_TRUE(sameBits(edited, fresh(after)));
        EXPECT_FALSE(sameBits(edited, unedited));

        // And back again: everything set as it was.
        before.fill(stage.edit);
        stage.render();
        EXPECT_TRUE(sameBits(stage.color(), unedited));
    }
}

TEST(Edit, SameValuesChangeNothing) {
    const Scene scene;
    Stage stage(withSamples(4));
    scene.fill(stage.edit);
    stage.film(48, 48);
    stage.render();
    Scene().fill(stage.edit); // equal meshes at other addresses
    EXPECT_TRUE(stage.renderer->commit(stage.edit).empty());
    stage.settings(withSamples(4));
    stage.film(48, 48);
    EXPECT_TRUE(stage.renderer->progress().converged);
    EXPECT_FALSE(stage.renderer->renderBatch());
}

TEST(Edit, ReportsTheInstanceThatMoved) {
    Scene scene;
    Stage stage(withSamples(4));
    scene.fill(stage.edit);
    stage.renderer->commit(stage.edit);
    scene.ballPlaces.transforms[1] = translation(0, 2, 0);
    stage.edit.setInstances(ids.balls, scene.ballPlaces);
    const ChangedSet changed = stage.renderer->commit(stage.edit);
    ASSERT_EQ(changed.elements.size(), 1u);
    EXPECT_EQ(std::get<ObjectId>(changed.elements[0].element), ids.balls);
    EXPECT_EQ(changed.elements[0].instance, 1u);
    EXPECT_EQ(changed.elements[0].change, Change::Transform);
}

TEST(Edit, SettingsThatMatterRestart) {
    Stage stage(withSamples(4));
    Scene().fill(stage.edit);
    stage.film(48, 48);
    stage.render();
    const ColorPicture before = stage.color();
    Settings settings = withSamples(4);
    settings.enableSceneMaterials = false;
    stage.settings(settings);
    EXPECT_FALSE(stage.renderer->progress().converged);
    stage.render();
    EXPECT_FALSE(sameBits(before, stage.color()));
    stage.settings(withSamples(4));
    stage.render();
    EXPECT_TRUE(sameBits(before, stage.color()));
}

TEST(Edit, InstancesShareTheirGeometry) {
    Stage stage(withSamples(4));
    const auto bytes = [&] {
        uint64_t geometry = 0, total = 0;
        for (const MemoryReport::Row& row : stage.renderer->memory().rows) {
            if (row.kind == "Geometry" || row.kind == "Primvars") geometry += row.bytes;
            total += row.bytes;
        }
        return std::pair(geometry, total);
    };
    const ObjectId object = stage.add(sphereMesh(25), matte(glm::vec3(0.5f))); // 2,450 triangles
    stage.edit.setCamera(lookAt({0, 0, 60}, {0, 0, 0}));
    stage.film(16, 16);
    stage.render();
    const auto single = bytes();
    InstancesDesc many;
    for (int i = 0; i < 531; ++i) // 1.3 million
        many.transforms.push_back(translation(float(i % 23) * 2.2f - 24, float(i / 23) * 2.2f - 24, 0));
    stage.edit.setInstances(object, many);
    stage.render();
    EXPECT_EQ(bytes().first, single.first);
    EXPECT_LT(bytes().second, single.second + 531 * 2048);
}
