#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/shading/blackbody.h"
#include "renderer/shading/dome.h"
#include "renderer/shading/light_choice.h"
#include "renderer/shading/light_shape.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/light_kernel.h"
#include "testenv/unit/shading/picture.h"
#include "testenv/unit/shading/sphere_grid.h"

namespace hipr::test {
namespace {

constexpr double Pi = 3.14159265358979323846;
const glm::vec3 Origin(0.f), Up(0.f, 0.f, 1.f);

gpu::LightRecord describe(const LightDesc& desc) {
    gpu::LightRecord record;
    std::string problem;
    EXPECT_TRUE(describeLight(desc, record, problem)) << problem;
    return record;
}

TEST(LightUnits, IntensityExposureColourAndArea) {
    LightDesc desc;
    desc.kind = LightKind::Rect;
    desc.width = 2.f;
    desc.height = 0.5f;
    desc.intensity = 3.f;
    desc.exposure = 2.f;
    desc.color = {1.f, 0.5f, 0.f};
    EXPECT_EQ(describe(desc).radiance, glm::vec3(12.f, 6.f, 0.f));
    desc.normalize = true;
    desc.transform = glm::scale(glm::dmat4(1.0), glm::dvec3(3.0, 2.0, 5.0));
    EXPECT_NEAR(describe(desc).radiance.x, 12.0 / 6.0, 1e-6);
}

TEST(LightUnits, NormalizeDividesByWorldArea) {
    LightDesc desc;
    desc.radius = 0.5f;
    desc.length = 2.f;
    const glm::dmat4 twice = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0));
    desc.transform = twice;
    const auto factor = [&](LightKind kind) {
        desc.kind = kind;
        return lightSizeFactor(desc);
    };
    EXPECT_NEAR(factor(LightKind::Sphere), 4.0 * Pi, 1e-3);
    EXPECT_NEAR(factor(LightKind::Disk), Pi, 1e-9);
    EXPECT_NEAR(factor(LightKind::Cylinder), 2.0 * Pi * 4.0, 1e-6);
    // A prolate spheroid, a = 1, c = 2, against its closed form.
    desc.transform = glm::scale(glm::dmat4(1.0), glm::dvec3(2.0, 2.0, 4.0));
    const double e = std::sqrt(1.0 - 1.0 / 4.0);
    EXPECT_NEAR(factor(LightKind::Sphere), 2.0 * Pi * (1.0 + 2.0 / e * std::asin(e)), 5e-3);
    desc.kind = LightKind::Distant;
    for (const double degrees : {0.53, 60.0, 180.0, 300.0}) {
        desc.angle = float(degrees);
        const double s = std::sin(0.5 * double(desc.angle) * Pi / 180.0);
        EXPECT_NEAR(lightSizeFactor(desc), degrees <= 180.0 ? Pi * s * s : Pi * (2.0 - s * s), 1e-9);
    }
    desc.angle = 0.f;
    EXPECT_EQ(lightSizeFactor(desc), 1.0);
}

/// Chromaticities of the Planckian locus: CIE illuminant A (2856 K) and 6504 K.
TEST(LightUnits, BlackbodyHasKnownChromaticities) {
    const auto chromaticity = [](float kelvin) {
        const glm::dvec3 c(blackbodyColor(kelvin));
        const double x = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z,
                     y = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z,
                     z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z;
        return glm::dvec2(x, y) / (x + y + z);
    };
    EXPECT_NEAR(chromaticity(2856.f).x, 0.4476, 3e-3);
    EXPECT_NEAR(chromaticity(2856.f).y, 0.4074, 3e-3);
    EXPECT_NEAR(chromaticity(6504.f).x, 0.3135, 3e-3);
    EXPECT_NEAR(chromaticity(6504.f).y, 0.3237, 3e-3);
    for (const float kelvin : {2000.f, 3000.f, 6500.f, 10000.f}) {
        const glm::vec3 c = blackbodyColor(kelvin);
        EXPECT_NEAR(0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z, 1.0, 1e-5) << kelvin;
    }
    EXPECT_EQ(blackbodyColor(1.f), blackbodyColor(1000.f));
    EXPECT_EQ(blackbodyColor(1000.f).z, 0.f); // outside Rec.709
}

TEST(LightTable, BrokenLightsAreOffAndToldOnce) {
    TextureStore textures(testDevice(), serve({}), ColorManager::create({}));
    CategoryTable categories(testDevice());
    LightTable table(testDevice(), textures, categories);
    const auto expectOff = [&](const char* name, auto change, bool told) {
        LightDesc desc;
        desc.name = name;
        change(desc);
        messageLog().entries.clear();
        table.set(LightId(1), desc);
        textures.commit();
        table.commit(glm::vec3(-1.f), glm::vec3(1.f));
        EXPECT_EQ(table.count(), 0u) << name;
        EXPECT_EQ(messageLog().count(name, "the light is off"), told ? 1 : 0) << name;
        EXPECT_EQ(messageLog().entries.size(), told ? 1u : 0u) << name;
    };
    const float nan = std::nanf("");
    expectOff(
        "/nan", [&](LightDesc& d) { d.intensity = nan; }, true);
    expectOff(
        "/inf", [&](LightDesc& d) { d.color.x = std::numeric_limits<float>::infinity(); }, true);
    expectOff(
        "/point", [](LightDesc& d) { d.radius = 0.f; }, true);
    expectOff(
        "/negative", [](LightDesc& d) { d.radius = -1.f; }, true);
    expectOff(
        "/flat", [](LightDesc& d) { d.transform = glm::scale(glm::dmat4(1.0), glm::dvec3(1, 0, 1)); }, true);
    expectOff(
        "/nanTransform", [&](LightDesc& d) { d.transform[3][0] = nan; }, true);
    expectOff(
        "/flatDome", [](LightDesc& d) { d.kind = LightKind::Dome, d.transform = glm::dmat4(0.0); }, true);
    expectOff(
        "/bright", [](LightDesc& d) { d.exposure = 500.f; }, true);
    expectOff(
        "/dark", [](LightDesc& d) { d.intensity = 0.f; }, false);
    expectOff(
        "/hidden", [](LightDesc& d) { d.visible = false; }, false);
    messageLog().entries.clear();
}

TEST(LightTable, AreaLightsComeFirstAndEditsShow) {
    TextureStore textures(testDevice(), serve({}), ColorManager::create({}));
    CategoryTable categories(testDevice());
    LightTable table(testDevice(), textures, categories);
    LightDesc dome, sphere;
    dome.kind = LightKind::Dome;
    table.set(LightId(1), dome);
    table.set(LightId(2), sphere);
    EXPECT_TRUE(table.commit(glm::vec3(-1.f), glm::vec3(1.f)));
    EXPECT_FALSE(table.commit(glm::vec3(-1.f), glm::vec3(1.f)));
    gpu::SceneRecord scene{};
    table.describe(scene);
    EXPECT_EQ(scene.lightCount, 2u);
    EXPECT_EQ(scene.areaLightCount, 1u);
    EXPECT_EQ(scene.infiniteLightCount, 1u);
    EXPECT_TRUE(table.commit(glm::vec3(-2.f), glm::vec3(2.f))); // the dome's power depends on the bounds
    table.remove(LightId(2));
    EXPECT_TRUE(table.commit(glm::vec3(-2.f), glm::vec3(2.f)));
    table.describe(scene);
    EXPECT_EQ(scene.areaLightCount, 0u);
}

TEST(LightChoice, FollowsPowerAndLeavesNoLightOut) {
    const std::vector<double> chances = lightChances({8.0, 1.0, 0.0});
    EXPECT_NEAR(chances[0], 0.9 * 8 / 9 + 0.1 / 3, 1e-12);
    EXPECT_NEAR(chances[1], 0.9 * 1 / 9 + 0.1 / 3, 1e-12);
    EXPECT_NEAR(chances[2], 0.1 / 3, 1e-12);
    EXPECT_EQ(lightChances({0.0, 0.0}), (std::vector<double>{0.5, 0.5}));
    EXPECT_EQ(cumulativeChances({0.25, 0.5, 0.25}), (std::vector<float>{0.25f, 0.75f, 1.f}));
    EXPECT_EQ(cumulativeChances(std::vector<double>(10, 0.1)).back(), 1.f);
}

// Paths that an edit of one light does not touch must stay the same paths.
TEST(LightChoice, IsLeftAloneByMostEdits) {
    EXPECT_EQ(lightChances({3.0, 20.0, 1.1}), lightChances({3.6, 19.0, 1.2}));
    EXPECT_NE(lightChances({3.0, 20.0, 1.1}), lightChances({9.0, 20.0, 1.1}));
}

/// A picture with a sun in it, rows from the top.
std::vector<float> sky(int width, int height) {
    std::vector<float> rgb;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                rgb.push_back(x == width / 3 && y == height / 4
                                  ? 400.f
                                  : 0.1f + 0.05f * float((3 * x + 5 * y + c) % 7));
    return rgb;
}

/// Radiance of `sky` along a direction, by the mapping as OpenEXR documents it and bilinear interpolation, in
/// float64.
double skyRadiance(const std::vector<float>& rgb, int width, int height, const glm::dvec3& d) {
    const double latitude = std::asin(glm::clamp(d.y, -1.0, 1.0)), longitude = std::atan2(d.x, d.z);
    const double x = (0.5 - longitude / (2.0 * Pi)) * width - 0.5, y = (0.5 - latitude / Pi) * height - 0.5;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    double sum = 0.0;
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i) {
            const double weight = (i ? x - x0 : 1.0 - (x - x0)) * (j ? y - y0 : 1.0 - (y - y0));
            const int column = ((x0 + i) % width + width) % width,
                      row = std::min(std::max(y0 + j, 0), height - 1);
            sum += weight * rgb[size_t(row * width + column) * 3 + 1];
        }
    return sum;
}

TEST(TexturedDome, IrradianceMappingAndDensity) {
    constexpr int Width = 32, Height = 16;
    const std::vector<float> rgb = sky(Width, Height);
    LightDesc dome;
    dome.name = "/dome";
    dome.kind = LightKind::Dome;
    dome.intensity = 2.f;
    dome.texture = "sky.exr";
    dome.transform = glm::rotate(glm::dmat4(1.0), 0.8, glm::normalize(glm::dvec3(1, 2, 0.5)));
    const LitScene scene({dome}, {{"sky.exr", encodeFloat("exr", Width, Height, 3, rgb)}});
    const glm::dmat3 toLight = glm::transpose(glm::dmat3(dome.transform));

    constexpr int Steps = 1200;
    double truth = 0.0;
    for (int i = 0; i < Steps; ++i)
        for (int j = 0; j < 2 * Steps; ++j) {
            const double z = std::sqrt((i + 0.5) / Steps),
                         phi = Pi * (j + 0.5) / Steps; // uniform in z^2: cosine-weighted
            const glm::dvec3 d(std::sqrt(1 - z * z) * std::cos(phi), std::sqrt(1 - z * z) * std::sin(phi), z);
            truth += 2.0 * Pi * skyRadiance(rgb, Width, Height, toLight * d) / (2.0 * Steps * Steps);
        }
    const Irradiance e = irradiance(scene, Origin, Up);
    EXPECT_NEAR(e.byLight.y, truth, 0.01 * truth);
    EXPECT_NEAR(e.combined.y, truth, 0.01 * truth);

    const SphereGrid grid(8, 16, 8);
    double integral = 0.0;
    const std::vector<LightOutcome> outcomes = scene.run(Origin, Up, grid.points().size(), grid.points());
    for (size_t i = 0; i < outcomes.size(); ++i) {
        const double expected = 2.0 * skyRadiance(rgb, Width, Height, toLight * glm::dvec3(grid.points()[i]));
        ASSERT_NEAR(outcomes[i].seen.y, expected, 2e-3 * expected + 1e-3);
        const double weight = outcomes[i].weighted.y / outcomes[i].seen.y;
        integral += std::sqrt(std::max(0.0, 1.0 / weight - 1.0)) * grid.area(i);
        if (outcomes[i].pdf > 0.f) {
            ASSERT_NEAR(outcomes[i].atSample, 0.5f, 0.02f);
        }
    }
    EXPECT_NEAR(integral, 1.0, 0.02);
}

TEST(TexturedDome, CardinalDirections) {
    // Left edge to right edge: -Z+, +X, +Z, -X, -Z; the top row is +Y.
    std::vector<float> rgb(8 * 4 * 3, 0.01f);
    for (int c = 0; c < 3; ++c) {
        rgb[size_t(1 * 8 + 2) * 3 + size_t(c)] = 10.f; // columns 1 and 2 surround s = 1/4
        rgb[size_t(1 * 8 + 1) * 3 + size_t(c)] = 10.f;
    }
    LightDesc dome;
    dome.kind = LightKind::Dome;
    dome.texture = "x.exr";
    const LitScene scene({dome}, {{"x.exr", encodeFloat("exr", 8, 4, 3, rgb)}});
    const std::vector<glm::vec3> directions = {
        glm::normalize(glm::vec3(1.f, 0.4f, 0.f)), glm::normalize(glm::vec3(0.f, 0.4f, 1.f)),
        glm::normalize(glm::vec3(-1.f, 0.4f, 0.f)), glm::normalize(glm::vec3(1.f, -0.4f, 0.f))};
    const std::vector<LightOutcome> seen = scene.run(Origin, Up, 4, directions);
    EXPECT_GT(seen[0].seen.y, 9.f);
    for (int i = 1; i < 4; ++i)
        EXPECT_LT(seen[size_t(i)].seen.y, 0.5f) << i;
}

TEST(TexturedDome, MissingPictureIsToldOnceAndUniform) {
    messageLog().entries.clear();
    LightDesc dome;
    dome.name = "/dome";
    dome.kind = LightKind::Dome;
    dome.texture = "missing.exr";
    const LitScene scene({dome});
    EXPECT_EQ(messageLog().count("/dome", "missing.exr: cannot be read"), 1);
    EXPECT_EQ(messageLog().entries.size(), 1u);
    EXPECT_NEAR(irradiance(scene, Origin, Up).combined.y, Pi, 0.01);
    messageLog().entries.clear();
}

TEST(TexturedDome, BlackPictureIsOff) {
    LightDesc dome;
    dome.kind = LightKind::Dome;
    dome.texture = "black.png";
    const LitScene scene({dome}, {{"black.png", encode8("png", 4, 2, 3, std::vector<uint8_t>(24))}});
    EXPECT_EQ(scene.record().lightCount, 0u);
    EXPECT_EQ(irradiance(scene, Origin, Up).combined.y, 0.0);
}

/// The lit side shows the picture upright: its left column at local +X (on the left for who looks at the
/// light).
TEST(TexturedRect, PictureIsUprightFromTheLitSide) {
    LightDesc rect;
    rect.kind = LightKind::Rect;
    rect.texture = "x.png";
    rect.transform = glm::translate(glm::dmat4(1.0), glm::dvec3(0, 0, 1));
    // Top left, top right, bottom left, bottom right.
    const LitScene scene({rect},
                         {{"x.png", encode8("png", 2, 2, 3, {255, 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0})}});
    const auto towards = [](float x, float y) { return glm::normalize(glm::vec3(x, y, 1.f)); };
    const std::vector<LightOutcome> seen =
        scene.run(Origin, Up, 3, {towards(0.4f, 0.4f), towards(-0.4f, 0.4f), towards(0.4f, -0.4f)});
    EXPECT_GT(seen[0].seen.y, 0.9f);
    EXPECT_LT(seen[1].seen.y, 0.1f);
    EXPECT_LT(seen[2].seen.y, 0.1f);
}

} // namespace
} // namespace hipr::test
