// Emissive meshes as lights: against lights of the same shape, against closed forms, and alone.
#include <functional>

#include <glm/gtc/constants.hpp>

#include "testenv/render/light_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

/// The variance of the mean of `samples` rays of the BSDF that each find the radiance or nothing.
double varianceWithoutLightSamples(const Shown& shown, double radiance, int samples) {
    const double most = radiance * double(FloorAlbedo), chance = shown.mean.y / most;
    return most * most * chance * (1.0 - chance) / samples;
}

/// Light that arrives at the origin from a square of a width of 1, z above it and x beside.
double irradiance(double z, double x, const std::function<double(double)>& radiance) {
    constexpr int Steps = 400;
    double sum = 0.0;
    for (int i = 0; i < Steps; ++i)
        for (int j = 0; j < Steps; ++j) {
            const double u = (i + 0.5) / Steps - 0.5, v = (j + 0.5) / Steps - 0.5;
            const double squared = (x + u) * (x + u) + v * v + z * z;
            sum += radiance(u) * z * z / (squared * squared) / (Steps * Steps);
        }
    return sum;
}

TEST(MeshLights, ASquareIsARectLight) {
    const glm::mat4x3 place = ceiling(1.f, 3.f);
    const glm::vec3 radiance(3.f, 5.f, 2.f);
    Floor mesh, light;
    mesh.add(quadMesh(), glowing(radiance), {place});
    light.add(rectLight(place, radiance));
    const Shown byMesh = mesh.shown(), byLight = light.shown();
    expectSame(byMesh, byLight);
    // A surface without a specular lobe is almost, but not quite, Lambert's.
    const double truth =
        5.0 * irradiance(3.0, 0.0, [](double) { return 1.0; }) * FloorAlbedo / glm::pi<double>();
    EXPECT_NEAR(byMesh.mean.y, truth, 0.03 * truth);
    EXPECT_LT(byMesh.variance, 1e-3 * varianceWithoutLightSamples(byMesh, 5.0, 64));
}

TEST(MeshLights, MayCastNoShadows) {
    Floor free, behind;
    for (Floor* floor : {&free, &behind})
        floor->add(quadMesh(), glowing(glm::vec3(5.f)), {ceiling(1.f, 3.f)});
    behind.add(quadMesh(), matte(glm::vec3(0.f)), {ceiling(2.f, 2.f)});
    const Shown lit = free.shown();
    EXPECT_EQ(behind.shown().mean.y, 0.0);
    Settings settings;
    settings.samples = 64;
    settings.maxDepth = 1;
    settings.enableShadows = false;
    behind.settings(settings);
    expectSame(behind.shown(), lit, 0.02); // rays that meet the mesh by chance are still stopped
}

TEST(MeshLights, ASphereIsASphereLight) {
    Floor mesh(256), light(256);
    const glm::mat4x3 place = placed(scaling(0.5f, 0.5f, 0.5f), 0.4f, 0.2f, 2.f);
    mesh.add(sphereMesh(64), glowing(glm::vec3(5.f)), {place});
    LightDesc sphere;
    sphere.kind = LightKind::Sphere;
    sphere.radius = 0.5f;
    sphere.transform = glm::translate(glm::dmat4(1), glm::dvec3(0.4, 0.2, 2.0));
    sphere.intensity = 5.f;
    light.add(sphere);
    expectSame(mesh.shown(), light.shown(), 0.003); // the mesh is a little smaller
}

TEST(MeshLights, InstancesScaledTurnedOverAndManyOfThem) {
    for (const int count : {3, 24}) {    // chosen by power, and by the tree
        std::vector<glm::mat4x3> places; // that hide nothing of each other: rect lights are ghosts
        for (int i = 0; i < count; ++i)
            places.push_back(placed(glm::mat4x3({0.1f + 0.1f * float(i % 3), 0, 0},
                                                {0, i % 2 ? 0.3f : -0.3f, 0}, {0, 0, -1.f}, {0, 0, 0}),
                                    0.5f * float(i % 6) - 1.25f, 0.5f * float(i / 6) - 0.75f, 1.5f));
        Floor mesh(256), light(256);
        mesh.add(quadMesh(), glowing(glm::vec3(5.f)), places);
        for (size_t i = 0; i < places.size(); ++i) {
            LightDesc rect = rectLight(places[i], glm::vec3(5.f));
            if (i % 2) rect.transform = rect.transform * glm::scale(glm::dmat4(1), glm::dvec3(1, -1, 1));
            rect.name = "/light" + std::to_string(i);
            light.add(rect);
        }
        const Shown byMesh = mesh.shown(), byLight = light.shown();
        expectSame(byMesh, byLight, RectSlack);
        EXPECT_LT(byMesh.variance, 0.02 * varianceWithoutLightSamples(byMesh, 5.0, 256)) << count;
    }
}

TEST(MeshLights, BothSidesEmit) {
    const glm::mat4x3 up = placed(glm::mat4x3(1.f), 0, 0, 3), down = ceiling(1.f, 3.f);
    Floor a, b;
    a.add(quadMesh(), glowing(glm::vec3(5.f)), {up});
    b.add(quadMesh(), glowing(glm::vec3(5.f)), {down});
    expectSame(a.shown(), b.shown());
}

/// Emission by a primvar: from 0 on one side to 2 on the other.
TEST(MeshLights, EmissionVariesOverTheMesh) {
    TrianglePrimvar glow;
    glow.name = "glow";
    glow.interpolation = Interpolation::Vertex;
    glow.components = 3;
    glow.values = {0, 0, 0, 2, 2, 2, 2, 2, 2, 0, 0, 0};
    MaterialDesc material = glowing(glm::vec3(1.f));
    material.emissiveColor.source = MaterialInput::Source::Primvar;
    material.emissiveColor.primvar = "glow";
    Floor mesh(256);
    mesh.add(quadMesh({glow}), material, {placed(glm::mat4x3(1.f), 1.f, 0.f, 1.f)});
    const auto at = [](const auto& radiance) {
        return irradiance(1.0, 1.0, radiance) * FloorAlbedo / glm::pi<double>();
    };
    const double truth = at([](double u) { return 1.0 + 2.0 * u; });
    ASSERT_GT(std::abs(truth - at([](double) { return 1.0; })), 0.1 * truth); // a mean would not do
    Floor even(256);
    even.add(quadMesh(), glowing(glm::vec3(1.f)), {placed(glm::mat4x3(1.f), 1.f, 0.f, 1.f)});
    const double lambert = even.shown().mean.y / at([](double) { return 1.0; }); // see ASquareIsARectLight
    EXPECT_NEAR(mesh.shown().mean.y, truth * lambert, 0.005 * truth);
}

TEST(MeshLights, SlotsThatEmitAndSlotsThatDoNot) {
    auto mesh = std::make_shared<TriangleMesh>(*quadMesh());
    mesh->triangleSlot = {0, 1};
    Floor half(256), whole(256);
    const glm::mat4x3 place = ceiling(1.f, 2.f);
    const ObjectId object = half.add(mesh, glowing(glm::vec3(5.f)), {place});
    const auto dark = half.renderer->newId<MaterialId>();
    half.edit.setMaterial(dark, matte(glm::vec3(0.f)));
    ObjectDesc desc;
    desc.name = "/half";
    desc.geometry = half.renderer->newId<GeometryId>();
    half.edit.setGeometry(desc.geometry, mesh);
    const auto bright = half.renderer->newId<MaterialId>();
    half.edit.setMaterial(bright, glowing(glm::vec3(5.f)));
    desc.materials = {dark, bright};
    half.edit.setObject(object, desc);
    whole.add(quadMesh(), glowing(glm::vec3(5.f)), {place});
    const Shown a = half.shown(), b = whole.shown();
    EXPECT_NEAR(a.mean.y, 0.5 * b.mean.y, 3.0 * a.error() + 0.01 * b.mean.y); // a diagonal over the centre
    EXPECT_LT(a.variance, 2.0 * b.variance);
}

TEST(MeshLights, OpacityTakesEmissionAlong) {
    MaterialDesc material = glowing(glm::vec3(5.f));
    material.opacity = constantValue(0.25f);
    material.opacityMode = OpacityMode::Presence;
    Floor thin(256), full(256);
    thin.add(quadMesh(), material, {ceiling(1.f, 2.f)});
    full.add(quadMesh(), glowing(glm::vec3(1.25f)), {ceiling(1.f, 2.f)});
    expectSame(thin.shown(), full.shown());
}

/// A glossy ball in a shell that glows evenly sees the same as under an even sky: light samples and rays of
/// the BSDF together count everything once.
TEST(MeshLights, AShellIsADome) {
    MaterialDesc glossy = matte(glm::vec3(0.4f));
    glossy.specularColor = constantColor(glm::vec3(0.6f));
    glossy.roughness = constantValue(0.3f);
    Floor shell(1024, glossy), dome(1024, glossy);
    shell.add(sphereMesh(32), glowing(glm::vec3(1.f)), {scaling(15, 15, 15)});
    LightDesc sky;
    sky.kind = LightKind::Dome;
    dome.add(sky);
    expectSame(shell.shown(), dome.shown(), 0.002);
}

/// What a light is made of: its power follows its material, also one of OpenPBR.
TEST(MeshLights, OpenPbrEmitsItsLuminance) {
    MaterialDesc material;
    material.name = "/glow";
    material.model = MaterialModel::OpenPbr;
    material.openPbr[OpenPbrInput::EmissionLuminance] = constantValue(5.f);
    material.openPbr[OpenPbrInput::EmissionColor] = constantColor(glm::vec3(1.f, 0.5f, 0.2f));
    Floor open, preview;
    open.add(quadMesh(), material, {ceiling(1.f, 3.f)});
    preview.add(quadMesh(), glowing(glm::vec3(5.f, 2.5f, 1.f)), {ceiling(1.f, 3.f)});
    const Shown a = open.shown(), b = preview.shown();
    expectSame(a, b);
    EXPECT_LT(a.variance, 2.0 * b.variance);
}

/// A lamp over a floor, with another object in front in the table of instances.
struct Lamp : Floor {
    explicit Lamp(const std::string& mode) : Floor(4, matte(glm::vec3(FloorAlbedo)), 3) {
        Settings settings;
        settings.samples = 4;
        settings.maxDepth = 3;
        settings.mode = mode;
        Stage::settings(settings);
        edit.setCamera(lookAt({0, -4, 3}, {0, 0, 0.5}, 50));
        edit.setGeometry(GeometryId(900), sphereMesh(12));
        edit.setMaterial(MaterialId(900), glowing(glm::vec3(4.f)));
        edit.setMaterial(MaterialId(901), matte(glm::vec3(0.7f)));
        object(true, MaterialId(900));
        place(1.f);
    }
    void object(bool visible, MaterialId material) {
        ObjectDesc desc;
        desc.name = "/lamp";
        desc.geometry = GeometryId(900);
        desc.materials = {material};
        desc.visible = visible;
        edit.setObject(ObjectId(900), desc);
    }
    void place(float height) {
        edit.setInstances(ObjectId(900), {{placed(scaling(0.4f, 0.4f, 0.4f), 0, 0, height)}, {}, {}});
    }
};

TEST(MeshLights, EditedIsAsFreshInAllModes) {
    const std::vector<std::function<void(Lamp&)>> edits = {
        [](Lamp& l) { l.edit.setMaterial(MaterialId(900), glowing(glm::vec3(1.f, 20.f, 1.f))); },
        [](Lamp& l) { l.object(true, MaterialId(901)); },
        [](Lamp& l) { l.object(true, MaterialId(900)); },
        [](Lamp& l) { l.place(1.6f); },
        [](Lamp& l) { l.object(false, MaterialId(900)); },
        [](Lamp& l) { l.object(true, MaterialId(900)); },
        [](Lamp& l) { l.edit.setGeometry(GeometryId(900), sphereMesh(5)); },
        [](Lamp& l) {
            l.add(sphereMesh(4), glowing(glm::vec3(2.f)), {placed(scaling(.1f, .1f, .1f), 1, 0, 1)});
        },
        [](Lamp& l) { l.edit.removeObject(ObjectId(900)); },
    };
    Lamp delta("delta"), uniform("uniform");
    delta.render();
    uniform.render();
    for (size_t i = 0; i < edits.size(); ++i) {
        const ColorPicture before = delta.color();
        for (Lamp* lamp : {&delta, &uniform}) {
            edits[i](*lamp);
            lamp->render();
        }
        Lamp fresh("delta");
        for (size_t k = 0; k <= i; ++k)
            edits[k](fresh);
        fresh.render();
        EXPECT_FALSE(sameBits(before, delta.color())) << i;
        EXPECT_TRUE(sameBits(fresh.color(), delta.color())) << i;
        EXPECT_TRUE(sameBits(fresh.color(), uniform.color())) << i;
    }
}

} // namespace
