// Volumes against closed forms and numeric integrals.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

#include "renderer/shading/blackbody.h"
#include "testenv/render/volume_kit.h"

using namespace hipr;
using namespace hipr::test;

TEST(Volumes, ConstantDensityFollowsBeersLaw) {
    for (const float density : {0.1f, 0.7f, 2.f}) {
        Box box;
        box.add({slab(density)}, absorbing(glm::vec3(1.f)));
        box.stage.add(sky());
        const glm::vec4 seen = box.shown();
        const float expected = through([=](int) { return density; }, 1.f);
        EXPECT_NEAR(seen.x, expected, box.spread(expected)) << density;
        EXPECT_NEAR(seen.w, 1.f - expected, box.spread(expected)) << density;
        EXPECT_EQ(seen.x, seen.y);
    }
}

TEST(Volumes, RampOfDensityFollowsItsIntegral) {
    const auto ramp = [](int i) { return 0.05f * float(i); };
    Box box(1024);
    box.add({slab(ramp)}, absorbing(glm::vec3(1.5f)));
    box.stage.add(sky());
    const float expected = through(ramp, 1.5f);
    EXPECT_NEAR(box.shown().x, expected, box.spread(expected));
}

TEST(Volumes, EveryColorIsAbsorbedByItsOwnLaw) {
    Box box(1024);
    const glm::vec3 absorption(0.1f, 0.4f, 1.f);
    box.add({slab(1.f)}, absorbing(absorption));
    box.stage.add(sky());
    const glm::vec4 seen = box.shown();
    for (int c = 0; c < 3; ++c) {
        const float expected = through([](int) { return 1.f; }, absorption[c]);
        EXPECT_NEAR(seen[c], expected, box.spread(expected)) << c; // weights vary less than all or nothing
    }
}

TEST(Volumes, TransformsMoveTheFieldAndNotItsUnits) {
    // Twice as deep by its scale; then turned, so that its depth lies along x, and far thinner along z.
    const glm::mat4x3 deeper = scaling(1, 1, 2);
    Box box;
    box.add({slab(0.3f)}, absorbing(glm::vec3(1.f)), {deeper});
    box.stage.add(sky());
    const float expected = std::exp(-0.3f * 2.f * float(Deep * Spacing));
    EXPECT_NEAR(box.shown().x, expected, box.spread(expected));

    Box turned;
    const glm::mat4x3 aside({0, 0, 0.5f}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0});
    turned.add({slab(0.3f)}, absorbing(glm::vec3(1.f)), {aside});
    turned.stage.add(sky());
    const float wide = std::exp(-0.3f * 0.5f * float(49 * Spacing));
    EXPECT_NEAR(turned.shown().x, wide, turned.spread(wide));
}

TEST(Volumes, InstancesAndOverlappingVolumesAddUp) {
    Box box;
    box.add({slab(0.2f)}, absorbing(glm::vec3(1.f)),
            {translation(0, 0, 0), translation(0, 0, -5), translation(0, 0, 0.5f)});
    box.add({slab(0.1f)}, absorbing(glm::vec3(2.f)), {translation(0, 0, 0.3f)});
    box.stage.add(sky());
    const float expected = std::exp(-0.8f * float(Deep * Spacing));
    EXPECT_NEAR(box.shown().x, expected, box.spread(expected));
}

TEST(Volumes, CameraAndSurfacesMayBeInside) {
    Box box;
    box.add({makeField({-24, -24, -24}, {24, 24, 24}, 0.5, [](glm::ivec3) { return 0.4f; })},
            absorbing(glm::vec3(1.f)));
    MaterialDesc lamp = matte(glm::vec3(0.f));
    lamp.emissiveColor = constantColor(glm::vec3(1.f));
    box.stage.add(quadMesh(), lamp, {placed(scaling(4, 4, 1), 0, 0, 8)});
    const float expected = std::exp(-0.4f * 1.9f); // from the near plane at z = 9.9 to z = 8
    EXPECT_NEAR(box.shown().x, expected, box.spread(expected));
}

TEST(Volumes, EmissionIsAttenuatedOnItsWay) {
    VolumeLook look = absorbing(glm::vec3(1.f));
    look.emission = {0.5f, 1.f, 2.f};
    Box bare(16);
    bare.add({nullptr, slab(0.3f)}, look);
    const glm::vec4 seen = bare.shown();
    for (int c = 0; c < 3; ++c) // a comb of points hardly varies
        EXPECT_NEAR(seen[c], look.emission[c] * 0.3f * float(Deep * Spacing), 0.01f * look.emission[c]);
    EXPECT_EQ(seen.w, 0.f);

    Box dark(1024);
    look.emissionByDensity = true;
    dark.add({slab(0.5f)}, look);
    const float expected = 1.f - through([](int) { return 0.5f; }, 1.f);
    const glm::vec4 glow = dark.shown();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(glow[c] / look.emission[c], expected, 0.01f);
}

TEST(Volumes, HotVolumesGlowAsBlackBodies) {
    VolumeLook look;
    look.temperatureScale = 1000.f;
    Box box(64);
    box.add({nullptr, nullptr, slab(3.f)}, look);
    const double radiance = 5.670374419e-14 / glm::pi<double>() * std::pow(3000.0, 4.0);
    // Its edges are cooler: one step from 0 to 3000 K on either side adds 2/5 of a step in full (the integral
    // of T^4).
    const glm::vec3 expected = blackbodyColor(3000.f) * float(radiance * Spacing * (Deep - 1 + 0.4));
    const glm::vec4 seen = box.shown();
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(seen[c], expected[c], 0.015f * expected[c]) << c;
}

TEST(Volumes, WhiteFurnace) {
    for (const float anisotropy : {0.f, 0.7f, -0.5f}) {
        Box box(256, 64);
        box.add({slab(1.5f)}, scattering(1.f, 1.f, anisotropy));
        box.add({slab(0.5f)}, scattering(2.f, 1.f, 0.3f), {translation(0.3f, 0, 0.7f)});
        box.stage.add(sky());
        const glm::vec4 seen = box.shown();
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], 1.f, 0.015f) << anisotropy;
    }
}

/// A lamp that both light samples and scattered rays find: thin fog beside a ball, against an integral in
/// small steps.
TEST(Volumes, SingleScatteringOfALampBesideTheVolume) {
    constexpr float Density = 0.02f, Radius = 1.f, Away = 2.5f;
    Box box(4096);
    box.add({slab(Density)}, scattering(1.f, 1.f));
    LightDesc ball;
    ball.name = "/ball";
    ball.radius = Radius;
    ball.intensity = 100.f;
    ball.transform = glm::translate(glm::dmat4(1), glm::dvec3(Away, 0, 1));
    box.stage.add(ball);
    double expected = 0;
    constexpr int Steps = 2000;
    for (int i = 0; i < Steps; ++i) {
        const double z =
            Deep * Spacing * (i + 0.5) / Steps - 0.5 * Spacing; // half of the edges' ramps lies outside
        const double squared = Away * Away + (z - 1) * (z - 1);
        const double angle = 2 * glm::pi<double>() * (1 - std::sqrt(1 - Radius * Radius / squared));
        const double before = Density * (Deep * Spacing - z), aside = Density * (std::sqrt(squared) - Radius);
        expected += Deep * Spacing / Steps * Density * 100 * angle / (4 * glm::pi<double>()) *
                    std::exp(-before - aside);
    }
    EXPECT_NEAR(box.shown().x, expected, 0.03 * expected);
}

TEST(Volumes, SingleScatteringOfADistantLight) {
    for (const float g : {0.f, 0.6f}) {
        Box box(1024);
        box.add({slab(0.4f)}, scattering(1.f, 0.5f, g));
        LightDesc sun;
        sun.name = "/sun";
        sun.kind = LightKind::Distant; // along -z, as the camera looks
        sun.angle = 0.f;
        sun.intensity = 10.f;
        box.stage.add(sun);
        const float depth = 0.4f * float(Deep * Spacing);
        const float phase =
            (1 - g * g) / (4 * glm::pi<float>() * std::pow(1 + g * g + 2 * g, 1.5f)); // back to the light
        const float expected = 10.f * 0.5f * phase * 0.5f * (1.f - std::exp(-2.f * depth));
        EXPECT_NEAR(box.shown().x, expected, 0.02f * expected) << g;
    }
}

/// A floor in the shadow of a cloud whose density is known everywhere, against the same floor in the sun and
/// an integral in small steps.
TEST(Volumes, ShadowsAreTheCloudsTransmittance) {
    const auto density = [](glm::ivec3 p) {
        return std::max(0.f, 1.5f - 0.1f * glm::length(glm::vec3(p))) * float(1 + (p.x & 1));
    };
    Stage stage(makeSettings(4096));
    stage.add(quadMesh(), matte(glm::vec3(1.f)), {placed(scaling(9, 9, 1), 0, 0, -3)});
    LightDesc sun;
    sun.name = "/sun";
    sun.kind = LightKind::Distant;
    sun.angle = 0.f;
    stage.add(sun);
    stage.edit.setCamera(lookAt({0.223, 0.117, -2.5}, {0.223, 0.117, -3}, 0.01)); // from below the cloud
    stage.film(4, 4);
    stage.render();
    const glm::vec4 lit = mean(stage.color());
    stage.edit.setField(FieldId(1), makeField(glm::ivec3(-16), glm::ivec3(16), 0.1, density));
    VolumeDesc desc;
    desc.name = "/cloud";
    desc.density = FieldId(1);
    desc.look = absorbing(glm::vec3(0.5f, 1.f, 1.f));
    stage.edit.setVolume(VolumeId(2), desc);
    ObjectDesc object;
    object.name = "/cloud";
    object.volume = VolumeId(2);
    stage.edit.setObject(ObjectId(900), object);
    const auto at = [&](double x, double y, double z) { // trilinear
        const glm::dvec3 p = glm::dvec3(x, y, z) / 0.1, f = p - glm::floor(p);
        const glm::ivec3 c(glm::floor(p));
        double sum = 0;
        for (int i = 0; i < 8; ++i) {
            const glm::ivec3 o(i & 1, i >> 1 & 1, i >> 2);
            const glm::dvec3 w = glm::mix(1.0 - f, f, glm::dvec3(o));
            sum += w.x * w.y * w.z * double(density(c + o));
        }
        return sum;
    };
    double depth = 0;
    for (int i = 0; i < 40000; ++i)
        depth += 1e-4 * at(0.223, 0.117, -2.0 + 1e-4 * (i + 0.5));
    stage.render();
    const glm::vec4 seen = mean(stage.color());
    EXPECT_NEAR(seen.x / lit.x, std::exp(-0.5 * depth), 0.01 * std::exp(-0.5 * depth));
    EXPECT_NEAR(seen.y / lit.y, std::exp(-depth), 0.015 * std::exp(-depth));
}

TEST(Volumes, PicturesAreTheSameInAllModesAndBatches) {
    std::vector<ColorPicture> pictures;
    for (const char* mode : {"uniform", "delta", "paper"}) {
        Settings settings = makeSettings(8, 4);
        settings.mode = mode;
        RendererInternals internals;
        internals.batchPaths = 500 + 300 * uint32_t(pictures.size());
        Stage stage(settings, internals);
        addFloor(stage);
        stage.add(sky());
        stage.edit.setField(FieldId(1), slab(1.f));
        VolumeDesc desc;
        desc.name = "/cloud";
        desc.density = desc.emission = FieldId(1);
        stage.edit.setVolume(VolumeId(2), desc);
        ObjectDesc object;
        object.name = "/cloud";
        object.volume = VolumeId(2);
        stage.edit.setObject(ObjectId(900), object);
        stage.edit.setCamera(lookAt({1, 2, 6}, {0, 0, 0}));
        stage.film(32, 32);
        stage.render();
        for (float x : {0.5f, -0.2f}) { // edits, which a fresh picture must not tell
            stage.edit.setInstances(ObjectId(900), {{translation(x, 0, 0)}, {}, {}, {}});
            stage.render();
        }
        pictures.push_back(stage.color());
        save(pictures.back(), std::string("volumes_") + mode);
    }
    EXPECT_TRUE(sameBits(pictures[0], pictures[1]));
    EXPECT_TRUE(sameBits(pictures[0], pictures[2]));
}
