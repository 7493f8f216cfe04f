// What the light of a mesh says beside what its material emits: shaping, shadows, links, multipliers. Against
// lights of the same shape, which do all that too.
#include <fstream>
#include <functional>

#include <glm/gtc/constants.hpp>
#include <gmock/gmock.h>

#include "testenv/render/light_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

const glm::vec3 Radiance(3.f, 5.f, 2.f);

/// A transform whose -Z, the axis of shapings, points from (x, 0, z) to the floor, `degrees` off straight
/// down.
glm::dmat4 aimed(double degrees, double x = 0.0, double z = 3.0) {
    return glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(x, 0, z)), glm::radians(degrees),
                       glm::dvec3(0.2, 1, 0));
}

glm::mat4x3 affine(const glm::dmat4& m) {
    return glm::mat4x3(glm::mat4(m));
}

LightDesc asRect(const SurfaceLight& light, const glm::dmat4& transform) {
    LightDesc rect;
    rect.kind = LightKind::Rect;
    rect.transform = transform;
    rect.color = Radiance;
    rect.diffuse = light.diffuse, rect.specular = light.specular;
    rect.shaping = light.shaping, rect.shadow = light.shadow;
    rect.lightLink = light.lightLink, rect.shadowLink = light.shadowLink;
    return rect;
}

/// Adds a mesh that is a light.
ObjectId addLamp(Stage& stage, std::shared_ptr<const TriangleMesh> mesh, const SurfaceLight& light,
                 std::vector<glm::mat4x3> transforms) {
    ObjectDesc desc;
    desc.light = std::make_shared<const SurfaceLight>(light);
    return stage.add(std::move(mesh), glowing(Radiance), std::move(transforms), desc);
}

/// What a floor shows under a square mesh that is a light, and under a rect light.
struct Pair {
    Shown mesh, rect;
};
using Addition = std::function<void(Floor&)>;
Pair bothOf(
    const SurfaceLight& light, const glm::dmat4& transform, const Addition& more = [](Floor&) {},
    const MaterialDesc& floor = matte(glm::vec3(FloorAlbedo)), int samples = 256) {
    Floor mesh(samples, floor), rect(samples, floor);
    addLamp(mesh, quadMesh(), light, {affine(transform)});
    rect.add(asRect(light, transform));
    more(mesh);
    more(rect);
    return {mesh.shown(), rect.shown()};
}

/// An object between lamps and floor.
void addOccluder(Floor& floor, const char* category = "occluder") {
    ObjectDesc desc;
    desc.categories = {category};
    floor.add(quadMesh(), matte(glm::vec3(0.f)), {placed(scaling(2.f, 2.f, 1.f), 0, 0, 1.5f)}, desc);
}

std::string profileFile() {
    const std::string path = ::testing::TempDir() + "hipr_surface_light.ies";
    std::ofstream(path) << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 4 3 1 2 0 0 0\n1 1 10\n"
                           "0 20 40 90\n0 45 90\n4 2 1 0\n4 3 0.5 0\n4 1 2 0\n";
    return path;
}

TEST(SurfaceLights, AreShapedAsARectLightIs) {
    std::vector<LightShaping> shapings(5);
    shapings[0].focus = 8.f;
    shapings[0].focusTint = {0.1f, 0.f, 0.5f};
    shapings[1].coneAngle = 24.f;
    shapings[2].coneAngle = 40.f;
    shapings[2].coneSoftness = 0.7f;
    shapings[3].iesFile = profileFile();
    shapings[4].iesFile = profileFile();
    shapings[4].iesNormalize = true;
    shapings[4].iesAngleScale = 0.7f;
    const glm::dmat4 place = aimed(25.0);
    const Pair plain = bothOf({}, place);
    for (size_t i = 0; i < shapings.size(); ++i) {
        SCOPED_TRACE(i);
        SurfaceLight light;
        light.shaping = shapings[i];
        const Pair both = bothOf(light, place);
        expectSame(both.mesh, both.rect);
        EXPECT_GT(both.mesh.mean.y, 0.02 * plain.mesh.mean.y);
        EXPECT_GT(std::abs(both.mesh.mean.y - plain.mesh.mean.y), 0.05 * plain.mesh.mean.y);
        EXPECT_LT(both.mesh.error(), 0.01 * both.mesh.mean.y) << "light samples go to it";
    }
}

TEST(SurfaceLights, AreSeenAsTheyAreShaped) {
    SurfaceLight light;
    light.shaping.coneAngle = 30.f;
    for (const bool within : {true, false}) {
        Stage stage(Floor::settingsOf(4, 1));
        addLamp(stage, quadMesh(), light, {affine(aimed(0.0, 0.0, 0.0))});
        stage.edit.setCamera(lookAt({0, within ? 0.5 : 2.0, -2}, {0, 0, 0}, 1));
        stage.film(8, 8);
        stage.render();
        const glm::vec4 seen = mean(stage.color());
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], within ? Radiance[c] : 0.f, 1e-4f);
        EXPECT_EQ(seen.w, 1.f);
    }
}

/// Scenes without lights are lit from the camera, also where something glows.
TEST(SurfaceLights, AreLights) {
    for (const bool light : {true, false}) {
        Stage stage(Floor::settingsOf(4, 1));
        stage.add(quadMesh(), matte(glm::vec3(FloorAlbedo)), {scaling(9.f, 9.f, 1.f)});
        ObjectDesc desc;
        if (light) desc.light = std::make_shared<const SurfaceLight>();
        stage.add(quadMesh(), glowing(glm::vec3(1e-6f)), {placed(scaling(.1f, .1f, .1f), 3, 0, 1)}, desc);
        stage.edit.setCamera(lookAt({0, 0.001, 2}, {0, 0, 0}, 1));
        stage.film(8, 8);
        stage.render();
        EXPECT_NEAR(mean(stage.color()).y, light ? 0.f : FloorAlbedo, 0.05f);
    }
}

/// With rays alone, too: from a mirror.
TEST(SurfaceLights, LightWhatTheyAreLinkedTo) {
    for (const MaterialDesc& floor : {matte(glm::vec3(FloorAlbedo)), mirror()}) {
        SurfaceLight linked, other;
        linked.lightLink = "floor";
        other.lightLink = "something else";
        const glm::dmat4 place = aimed(0.0);
        const Pair plain = bothOf(
            {}, place, [](Floor&) {}, floor);
        const Pair lit = bothOf(
            linked, place, [](Floor&) {}, floor);
        const Pair unlit = bothOf(
            other, place, [](Floor&) {}, floor);
        ASSERT_GT(plain.mesh.mean.y, 0.0);
        expectSame(lit.mesh, plain.mesh);
        EXPECT_EQ(unlit.mesh.mean, glm::dvec3(0.0));
        EXPECT_EQ(unlit.rect.mean, glm::dvec3(0.0));
    }
}

TEST(SurfaceLights, ShadowsAreAsTheLightHasThem) {
    const glm::dmat4 place = aimed(0.0);
    const Pair free = bothOf({}, place);
    std::vector<SurfaceLight> lights(5);
    lights[0].shadow.enable = false;
    lights[1].shadow.color = {0.2f, 0.5f, 0.f};
    lights[2].shadow.distance = 1.f;
    lights[3].shadow.distance = 3.f;
    lights[3].shadow.falloff = 2.f;
    lights[4].shadowLink = "others";
    const auto shade = [](Floor& floor) { addOccluder(floor); };
    EXPECT_EQ(bothOf({}, place, shade).mesh.mean, glm::dvec3(0.0));
    for (size_t i = 0; i < lights.size(); ++i) {
        SCOPED_TRACE(i);
        const Pair both = bothOf(lights[i], place, shade);
        expectSame(both.mesh, both.rect, 0.01); // as rays that meet the light by chance are stopped
        if (i == 0 || i == 2 || i == 4) expectSame(both.mesh, free.mesh, 0.02);
    }
    SurfaceLight linked;
    linked.shadowLink = "occluder";
    EXPECT_EQ(bothOf(linked, place, shade).mesh.mean, glm::dvec3(0.0));
}

/// The far side of a ball is behind the near one, whatever shadows others cast.
TEST(SurfaceLights, HideTheirOwnFarSide) {
    const std::vector<glm::mat4x3> place = {placed(scaling(0.5f, 0.5f, 0.5f), 0.f, 0.f, 3.f)};
    Floor plain(256);
    addLamp(plain, sphereMesh(24), {}, place);
    const Shown truth = plain.shown();
    SurfaceLight noShadow, linked;
    noShadow.shadow.enable = false;
    linked.shadowLink = "nothing";
    for (const SurfaceLight& light : {noShadow, linked}) {
        Floor floor(256);
        addLamp(floor, sphereMesh(24), light, place);
        addOccluder(floor);
        expectSame(floor.shown(), truth, 0.02);
    }
    Settings settings = Floor::settingsOf(256, 1);
    settings.enableShadows = false;
    plain.settings(settings);
    expectSame(plain.shown(), truth, 0.002);
}

TEST(SurfaceLights, HaveDiffuseAndSpecularMultipliers) {
    MaterialDesc glossy = matte(glm::vec3(0.4f));
    glossy.specularColor = constantColor(glm::vec3(0.6f));
    glossy.roughness = constantValue(0.5f);
    const glm::dmat4 place = aimed(0.0);
    const Pair plain = bothOf(
        {}, place, [](Floor&) {}, glossy);
    glm::dvec3 sum(0.0);
    for (const bool diffuse : {true, false}) {
        SurfaceLight light;
        light.diffuse = diffuse ? 2.f : 0.f;
        light.specular = diffuse ? 0.f : 2.f;
        const Pair both = bothOf(
            light, place, [](Floor&) {}, glossy);
        expectSame(both.mesh, both.rect, RectSlack);
        EXPECT_GT(both.mesh.mean.y, 0.05 * plain.mesh.mean.y);
        sum += both.mesh.mean;
    }
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(sum[c], 2.0 * plain.mesh.mean[c], 0.01 * plain.mesh.mean[c]);
}

/// By the tree of lights, which knows of cones and links.
TEST(SurfaceLights, ManyInstancesAndLinks) {
    SurfaceLight cone, linked, other;
    cone.shaping.coneAngle = 35.f;
    cone.shaping.coneSoftness = 0.5f;
    linked = cone;
    linked.lightLink = "floor";
    other = cone;
    other.lightLink = "something else";
    Floor mesh(256), rects(256);
    for (int k = 0; k < 3; ++k) {
        const SurfaceLight& light = k == 0 ? cone : k == 1 ? linked : other;
        std::vector<glm::mat4x3> places;
        for (int i = 0; i < 8; ++i) {
            const glm::dmat4 beside = glm::translate(glm::dmat4(1), glm::dvec3(0.0, 0.5 * k - 0.5, 0.0));
            const glm::dmat4 place = beside * glm::scale(aimed(7.0 * i - 20.0, 0.4 * i - 1.4, 2.0 + 0.2 * k),
                                                         glm::dvec3(0.1, 0.2, 1.0));
            places.push_back(affine(place));
            LightDesc rect = asRect(light, place);
            rect.name = "/rect" + std::to_string(8 * k + i);
            if (k < 2) rects.add(rect);
        }
        addLamp(mesh, quadMesh(), light, places);
    }
    const Shown byMesh = mesh.shown();
    expectSame(byMesh, rects.shown(), RectSlack);
    EXPECT_LT(byMesh.error(), 0.01 * byMesh.mean.y);
}

/// What moves is found by rays alone, which follow links and shaping. The rest is said.
TEST(SurfaceLights, MayMove) {
    const auto shown = [](const SurfaceLight& light, std::string* said = nullptr) {
        Floor floor(256);
        CameraDesc camera = lookAt({0, 0.001, 0.3}, {0, 0, 0}, 1);
        camera.shutter = {0.0, 0.5};
        floor.edit.setCamera(camera);
        const ObjectId lamp = addLamp(floor, quadMesh(), light, {glm::mat4x3(1.f)});
        const auto at = [](float x) { return placed(scaling(4.f, 4.f, 1.f), x, 0.f, 2.f); };
        InstancesDesc moving;
        moving.transforms = {at(0.f)};
        moving.motion.times = {0.f, 0.5f};
        moving.motion.transforms = {{at(0.f)}, {at(0.2f)}};
        floor.edit.setInstances(lamp, moving);
        const Shown result = floor.shown();
        for (const Message& message : floor.messages())
            if (said && message.severity == Severity::Warning) *said += message.text;
        return result;
    };
    SurfaceLight linked, other, cone, unusual;
    linked.lightLink = "floor";
    other.lightLink = "something else";
    cone.shaping.coneAngle = 20.f;
    unusual.shadow.enable = false;
    unusual.diffuse = 0.f;
    const Shown plain = shown({});
    ASSERT_GT(plain.mean.y, 0.0);
    expectSame(shown(linked), plain);
    EXPECT_EQ(shown(other).mean, glm::dvec3(0.0));
    // Of a large square a cone leaves a disk: radiance * albedo * sine^2.
    const Shown within = shown(cone);
    const double sine = std::sin(glm::radians(20.0)), truth = 5.0 * double(FloorAlbedo) * sine * sine;
    EXPECT_NEAR(within.mean.y, truth, 3.0 * within.error() + 0.03 * truth);
    std::string said;
    expectSame(shown(unusual, &said), plain);
    EXPECT_THAT(said, testing::HasSubstr("multipliers, shadows and shadow linking have no effect"));
}

TEST(SurfaceLights, OfNumbersThatAreNoneShineAsTheirMaterial) {
    Floor floor, plain;
    SurfaceLight light;
    light.shaping.focus = std::numeric_limits<float>::quiet_NaN();
    addLamp(floor, quadMesh(), light, {affine(aimed(0.0))});
    addLamp(plain, quadMesh(), {}, {affine(aimed(0.0))});
    expectSame(floor.shown(), plain.shown());
    std::vector<std::string> said;
    for (const Message& message : floor.messages())
        said.push_back(message.text);
    EXPECT_THAT(said, testing::Contains(testing::HasSubstr("a value of its light is not finite")));
}

/// A ball lamp and a box beside it, over a floor.
struct EditedLamp : Floor {
    explicit EditedLamp(const std::string& mode) : Floor(4, matte(glm::vec3(FloorAlbedo)), 3) {
        Settings settings = settingsOf(4, 3);
        settings.mode = mode;
        Stage::settings(settings);
        edit.setCamera(lookAt({0, -4, 3}, {0, 0, 0.5}, 50));
        edit.setGeometry(GeometryId(900), sphereMesh(12));
        edit.setMaterial(MaterialId(900), glowing(glm::vec3(4.f)));
        edit.setInstances(ObjectId(900), {{placed(scaling(0.4f, 0.4f, 0.4f), 0, 0, 1.5f)}, {}, {}});
        addOccluder(*this);
        light({});
    }
    void light(const SurfaceLight& light, bool any = true) {
        ObjectDesc desc;
        desc.name = "/lamp";
        desc.geometry = GeometryId(900);
        desc.materials = {MaterialId(900)};
        if (any) desc.light = std::make_shared<const SurfaceLight>(light);
        edit.setObject(ObjectId(900), desc);
    }
};

TEST(SurfaceLights, EditedIsAsFreshInAllModes) {
    std::vector<SurfaceLight> lights(6);
    lights[0].shaping.coneAngle = 50.f;
    lights[1].shaping.focus = 3.f;
    lights[2].shadow.color = {0.5f, 0.1f, 0.f};
    lights[3].lightLink = "floor";
    lights[4].shadowLink = "others";
    lights[5].specular = 0.f;
    lights[5].diffuse = 0.5f;
    EditedLamp delta("delta"), uniform("uniform");
    delta.render();
    uniform.render();
    for (size_t i = 0; i <= lights.size(); ++i) {
        const bool any = i < lights.size(); // in the end it has none
        const SurfaceLight light = any ? lights[i] : SurfaceLight();
        const ColorPicture before = delta.color();
        EditedLamp fresh("delta");
        for (EditedLamp* lamp : {&delta, &uniform, &fresh}) {
            lamp->light(light, any);
            lamp->render();
        }
        EXPECT_FALSE(sameBits(before, delta.color())) << i;
        EXPECT_TRUE(sameBits(fresh.color(), delta.color())) << i;
        EXPECT_TRUE(sameBits(fresh.color(), uniform.color())) << i;
    }
}

} // namespace
