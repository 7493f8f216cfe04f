// Shadows that are not plain, and light linking: a floor lit past occluders, against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr float Albedo = 0.5f, Height = 4.f, Radius = 0.2f;

/// A ball over the floor, at z = 4.
LightDesc lamp(float radius = Radius) {
    LightDesc light;
    light.name = "/lamp";
    light.kind = LightKind::Sphere;
    light.transform = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, double(Height)));
    light.radius = radius;
    light.intensity = 100.f;
    return light;
}

/// A floor at z = 0 and squares of a width of 3 over it, seen from between the floor and the lowest square.
class Room {
public:
    explicit Room(uint32_t samples = 64) : stage(makeSettings(samples)) {
        addObject("/floor", matte(glm::vec3(Albedo)), 0.f, 40.f, {});
        stage.edit.setCamera(lookAt({0, 0, 0.8}, {0, 0, 0}, 4));
        stage.film(8, 8);
    }
    void addObject(const char* name, MaterialDesc material, float z, float width,
                   std::vector<std::string> categories) {
        const auto id = ++_lastId;
        material.name = std::string(name) + "/look";
        stage.edit.setGeometry(GeometryId(id), quadMesh());
        stage.edit.setMaterial(MaterialId(id), material);
        ObjectDesc desc{name, GeometryId(id), {MaterialId(id)}};
        desc.categories = std::move(categories);
        stage.edit.setObject(ObjectId(id), desc);
        stage.edit.setInstances(ObjectId(id), {{placed(scaling(width, width, 1), 0, 0, z)}, {}, {}, {}});
    }
    void addOccluder(float z, std::vector<std::string> categories = {}, float opacity = 1.f) {
        MaterialDesc material = matte(glm::vec3(0.f));
        material.opacity = constantValue(opacity);
        material.opacityMode = OpacityMode::Presence;
        addObject(("/occluder" + std::to_string(_lastId)).c_str(), material, z, 3.f, std::move(categories));
    }
    void enableShadows(bool shadows) {
        Settings settings = makeSettings(64);
        settings.enableShadows = shadows;
        stage.settings(settings);
    }
    glm::vec3 shown(const LightDesc& light) {
        stage.edit.setLight(LightId(900), light);
        stage.render();
        return glm::vec3(mean(stage.color()));
    }

    Stage stage;

private:
    static Settings makeSettings(uint32_t samples) {
        Settings settings;
        settings.samples = int(samples);
        settings.maxDepth = 1;
        return settings;
    }
    uint32_t _lastId = 500;
};

/// What the floor below the lamp shows when nothing is in between.
float lit() {
    static const float value = Room().shown(lamp()).x;
    return value;
}

void expectNear(const glm::vec3& value, const glm::vec3& truth, float tolerance = 0.01f) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], truth[c], tolerance * lit()) << c;
}

TEST(Shadows, OfALampWithoutAny) {
    // Radiance * (r / d)^2 * albedo; a surface without a specular lobe is almost, but not quite, Lambert's.
    EXPECT_NEAR(lit(), 100.f * Radius * Radius / (Height * Height) * Albedo, 0.03f * lit());
    Room room;
    room.addOccluder(2.f);
    EXPECT_EQ(room.shown(lamp()), glm::vec3(0.f));
    LightDesc light = lamp();
    light.shadow.enable = false;
    expectNear(room.shown(light), glm::vec3(lit()));
    light.shadow.color = {0.f, 0.f, 0.f}; // of no shadow
    light.shadow.distance = 100.f;
    expectNear(room.shown(light), glm::vec3(lit()));
}

/// By a setting, of all lights, and back.
TEST(Shadows, OfNoLight) {
    Room room;
    room.addOccluder(2.f);
    room.enableShadows(false);
    expectNear(room.shown(lamp()), glm::vec3(lit()));
    room.enableShadows(true);
    EXPECT_EQ(room.shown(lamp()), glm::vec3(0.f));
}

TEST(Shadows, HaveAColour) {
    Room room;
    room.addOccluder(2.f);
    LightDesc light = lamp();
    light.shadow.color = {0.2f, 0.5f, 1.f};
    expectNear(room.shown(light), lit() * light.shadow.color);
}

/// The occluder is 2 from the floor.
TEST(Shadows, EndAtADistance) {
    Room room;
    room.addOccluder(2.f);
    LightDesc light = lamp();
    light.shadow.distance = 1.8f;
    expectNear(room.shown(light), glm::vec3(lit()));
    light.shadow.distance = 2.2f;
    EXPECT_EQ(room.shown(light), glm::vec3(0.f));
    light.shadow.falloff = 0.1f; // from 2.1 on
    EXPECT_EQ(room.shown(light), glm::vec3(0.f));
    light.shadow.distance = 3.f;
    light.shadow.falloff = 2.f; // strength falls from 1 at 1 to 0 at 3
    expectNear(room.shown(light), glm::vec3(0.5f * lit()));
    light.shadow.falloffGamma = 2.f;
    expectNear(room.shown(light), glm::vec3(0.75f * lit()));
    light.shadow.color = {0.f, 0.5f, 1.f};
    expectNear(room.shown(light), lit() * glm::vec3(0.75f, 0.875f, 1.f));
    light.shadow.falloff = 10.f; // no more than the distance: from 0 on
    expectNear(room.shown(light), lit() * glm::vec3(8.f / 9.f, 17.f / 18.f, 1.f));
}

/// Half of the light is stopped by each of two sheets, and gets through as the shadow has it.
TEST(Shadows, OfSurfacesThatLetLightThrough) {
    Room room;
    room.addOccluder(2.f, {}, 0.5f);
    room.addOccluder(3.f, {}, 0.5f);
    expectNear(room.shown(lamp()), glm::vec3(0.25f * lit()));
    LightDesc light = lamp();
    light.shadow.color = {0.f, 0.2f, 1.f};
    expectNear(room.shown(light), lit() * (0.25f + 0.75f * light.shadow.color));
}

/// Neither half of the estimate may count what the other counts: a large lamp over a glossy floor, where both
/// find it, and occluders that hide a part of it.
TEST(Shadows, KeepTheBalanceOfTheEstimate) {
    MaterialDesc glossy = matte(glm::vec3(0.3f));
    glossy.specularColor = constantColor(glm::vec3(0.5f));
    glossy.roughness = constantValue(0.3f);
    for (const float opacity : {1.f, 0.6f}) {
        glm::vec3 values[2];
        for (const bool occluded : {false, true}) {
            Room room(1024);
            room.addObject("/floor", glossy, 0.001f, 40.f, {});
            if (occluded) room.addOccluder(2.f, {}, opacity);
            LightDesc light = lamp(1.8f);
            light.transform = glm::translate(glm::dmat4(1), glm::dvec3(1, 0, 4));
            light.shadow.enable = false;
            values[occluded] = room.shown(light);
        }
        EXPECT_GT(values[0].y, 1.f);
        EXPECT_NEAR(values[1].y, values[0].y, 0.01f * values[0].y) << opacity;
    }
}

TEST(LightLinking, LightsWhatItIsLinkedTo) {
    LightDesc light = lamp();
    light.lightLink = "lit";
    Room room;
    EXPECT_EQ(room.shown(light), glm::vec3(0.f));
    room.addObject("/other", matte(glm::vec3(Albedo)), 0.001f, 40.f, {"other"});
    EXPECT_EQ(room.shown(light), glm::vec3(0.f));
    room.addObject("/linked", matte(glm::vec3(Albedo)), 0.002f, 40.f, {"another", "lit"});
    expectNear(room.shown(light), glm::vec3(lit()));
}

/// Lights of all kinds, met by rays as well: nothing but the camera may see them.
TEST(LightLinking, HoldsForLightThatRaysMeet) {
    for (const LightKind kind : {LightKind::Dome, LightKind::Distant, LightKind::Rect}) {
        Room room;
        MaterialDesc glossy;
        glossy.roughness = constantValue(0.f);
        glossy.metallic = constantValue(1.f);
        room.addObject("/mirror", glossy, 0.001f, 40.f, {});
        LightDesc light = lamp();
        light.kind = kind;
        light.angle = 60.f;
        light.width = light.height = 10.f;
        EXPECT_GT(room.shown(light).y, 1.f) << int(kind);
        light.lightLink = "lit";
        EXPECT_EQ(room.shown(light), glm::vec3(0.f)) << int(kind);
    }
}

TEST(LightLinking, OfInstances) {
    Room room;
    const ObjectId id{700};
    room.stage.edit.setGeometry(GeometryId(700), quadMesh());
    room.stage.edit.setMaterial(MaterialId(700), matte(glm::vec3(Albedo)));
    room.stage.edit.setObject(id, {"/halves", GeometryId(700), {MaterialId(700)}});
    InstancesDesc halves{
        {placed(scaling(10, 10, 1), -5, 0, 0.01f), placed(scaling(10, 10, 1), 5, 0, 0.01f)}, {}, {}};
    halves.categories = {{}, {"lit"}};
    room.stage.edit.setInstances(id, halves);
    LightDesc light = lamp();
    light.lightLink = "lit";
    room.shown(light);
    const ColorPicture picture = room.stage.color();
    EXPECT_EQ(picture.at(1, 4).x, 0.f);
    EXPECT_NEAR(picture.at(6, 4).x, lit(), 0.02f * lit());
}

TEST(ShadowLinking, ShadowsOfWhatItIsLinkedTo) {
    LightDesc light = lamp();
    light.shadowLink = "casts";
    Room room;
    room.addOccluder(1.f, {"other"});
    EXPECT_EQ(room.shown(lamp()), glm::vec3(0.f));
    expectNear(room.shown(light), glm::vec3(lit()));
    room.addOccluder(2.f, {"casts"}, 0.5f); // behind the other
    expectNear(room.shown(light), glm::vec3(0.5f * lit()));
    room.addOccluder(3.f, {"casts"});
    EXPECT_EQ(room.shown(light), glm::vec3(0.f));
}

TEST(ShadowLinking, KeepsTheBalanceOfTheEstimate) {
    MaterialDesc glossy = matte(glm::vec3(0.3f));
    glossy.specularColor = constantColor(glm::vec3(0.5f));
    glossy.roughness = constantValue(0.3f);
    glm::vec3 values[2];
    for (const bool occluded : {false, true}) {
        Room room(1024);
        room.addObject("/floor", glossy, 0.001f, 40.f, {});
        if (occluded) room.addOccluder(2.f, {}, 0.7f);
        LightDesc light = lamp(1.8f);
        light.transform = glm::translate(glm::dmat4(1), glm::dvec3(1, 0, 4));
        light.shadowLink = "casts";
        values[occluded] = room.shown(light);
    }
    EXPECT_NEAR(values[1].y, values[0].y, 0.01f * values[0].y);
}

} // namespace
