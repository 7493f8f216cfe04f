// What a path covers of a texture: pictures of checkers that are known when they are blurred.
#include <cmath>

#include <gtest/gtest.h>

#include "testenv/render/picture_file.h"
#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

/// Black and white squares of one texel.
PictureFile checker() {
    return {"checker", 64, [](uint32_t x, uint32_t y) { return (x + y) % 2 ? 255 : 0; }};
}

MaterialInput textured(const PictureFile& file, float repeat = 1.f) {
    MaterialInput input;
    input.source = MaterialInput::Source::Texture;
    input.channel = Channel::Rgb;
    input.texture.path = file.path();
    input.texture.colorSpace = "raw";
    input.texture.wrapS = input.texture.wrapT = WrapMode::Repeat;
    input.texture.uvTransform = glm::mat3x2(repeat, 0.f, 0.f, repeat, 0.f, 0.f);
    return input;
}

MaterialDesc glowing(const MaterialInput& input) {
    MaterialDesc desc = matte(glm::vec3(0.f));
    desc.emissiveColor = input;
    return desc;
}

std::shared_ptr<const TriangleMesh> sheet() {
    return quadMesh({{"st", Interpolation::Vertex, 2, {0, 0, 1, 0, 1, 1, 0, 1}}});
}

/// How far pixels are from one half, root of the mean square.
double contrast(const ColorPicture& picture) {
    double sum = 0;
    for (const glm::vec4& v : picture.values)
        sum += (double(v.x) - 0.5) * (double(v.x) - 0.5) / double(picture.values.size());
    return std::sqrt(sum);
}

/// A sheet that fills the picture with `texels` texels of the checker a pixel, seen by sample 0 alone.
double contrastAt(double texels, CameraDesc camera, bool filtering = true) {
    const PictureFile file = checker();
    Settings settings;
    settings.samples = 1;
    settings.textureFiltering = filtering;
    settings.pixelFilter = "box";
    Stage stage(settings);
    const uint32_t pixels = 40; // over one unit of length at the sheet
    stage.add(sheet(), glowing(textured(file, float(texels * pixels / 64.0))), {scaling(2, 2, 1)});
    stage.edit.setCamera(camera);
    stage.film(pixels, pixels);
    stage.render();
    return contrast(stage.color());
}

/// Sees one unit of length at the origin.
CameraDesc perspective() {
    return lookAt({0, 0, 5}, {0, 0, 0}, glm::degrees(2.0 * std::atan(0.1)));
}

CameraDesc orthographic() {
    CameraDesc camera = perspective();
    camera.projection = glm::orthoRH_NO(-0.5, 0.5, -0.5, 0.5, 0.1, 100.0);
    return camera;
}

/// The quad is twice as large as what is seen, so that `texels` a pixel are 2 * texels for textured()'s
/// scale.
constexpr double OfQuad = 2.0;

} // namespace

/// Blurred, squares of one texel are an even grey: all paths take level 1 where a pixel covers two texels,
/// none where it covers less than one.
TEST(TextureFilter, APixelCoversAsManyTexelsAsTheCameraSays) {
    for (const auto& [name, camera] :
         {std::pair("perspective", perspective()), std::pair("orthographic", orthographic())}) {
        EXPECT_LT(contrastAt(OfQuad * 2.1, camera), 0.003) << name;
        EXPECT_NEAR(contrastAt(OfQuad * 0.97, camera), contrastAt(OfQuad * 0.97, camera, false), 1e-9)
            << name;
        // Between them levels are chosen at random: half of the paths at the square root.
        const double sharp = contrastAt(OfQuad * std::sqrt(2.0), camera, false);
        EXPECT_NEAR(contrastAt(OfQuad * std::sqrt(2.0), camera), std::sqrt(0.5) * sharp, 0.06 * sharp)
            << name;
    }
}

TEST(TextureFilter, WhatIsOutOfFocusIsBlurred) {
    CameraDesc camera = perspective();
    camera.lens.focusDistance = 5;
    camera.lens.radius = 0.4;
    EXPECT_GT(contrastAt(OfQuad * 0.97, camera), 0.1);
    camera.lens.focusDistance = 4;
    EXPECT_LT(contrastAt(OfQuad * 0.97, camera), 0.003);
}

namespace {

/// A floor of squares up to the horizon, seen by sample 0 alone; its part of the picture.
std::vector<float> horizon(bool filtering) {
    const PictureFile file = checker();
    Settings settings;
    settings.samples = 1;
    settings.textureFiltering = filtering;
    Stage stage(settings);
    stage.add(sheet(), glowing(textured(file, 60.f)),
              {glm::mat4x3({200, 0, 0}, {0, 0, -200}, {0, 200, 0}, {0, -1, 0})});
    LightDesc dark; // lest the camera be one
    dark.kind = LightKind::Dome;
    dark.intensity = 0.f;
    stage.add(dark);
    stage.edit.setCamera(lookAt({0, 0, 0}, {0, 0, -10}));
    stage.film(40, 40);
    stage.render();
    std::vector<float> seen;
    const ColorPicture picture = stage.color();
    for (uint32_t y = 10; y < 17; ++y) // rows 0 to 19 are below the horizon
        for (uint32_t x = 0; x < 40; ++x)
            seen.push_back(picture.at(x, y).x);
    return seen;
}

/// Two sheets side by side, of 512 x 512 texels each.
struct Sheets {
    PictureFile first{"first", 512, [](uint32_t x, uint32_t y) { return (x / 3 + y / 5) % 2 ? 240 : 30; }};
    PictureFile second{"second", 512, [](uint32_t x, uint32_t y) { return (x * y) % 251; }};

    void show(Stage& stage, bool left, bool right) const {
        if (left) stage.add(sheet(), glowing(textured(first)), {translation(-0.5f, 0, 0)});
        if (right) stage.add(sheet(), glowing(textured(second)), {translation(0.5f, 0, 0)});
        stage.edit.setCamera(lookAt({0, 0, 0.3}, {0, 0, 0})); // two texels a pixel
        stage.film(48, 48);
    }
    static Settings limited(const std::string& mode = "delta") {
        Settings settings;
        settings.samples = 4;
        settings.mode = mode;
        settings.textureMemory = 2; // of 2 2/3
        return settings;
    }
};

} // namespace

TEST(TextureFilter, TheHorizonIsTheMeanOfTheTexture) {
    double noise = 0, withoutFilter = 0;
    for (const float v : horizon(true)) {
        EXPECT_NEAR(v, 0.5f, 0.004f);
        noise += double(v - 0.5f) * double(v - 0.5f);
    }
    for (const float v : horizon(false))
        withoutFilter += double(v - 0.5f) * double(v - 0.5f);
    EXPECT_GT(withoutFilter, 1000 * noise);
}

/// What is left out for want of memory follows from the scene and the settings, not from what was there
/// before.
TEST(TextureFilter, EditedLimitsEqualFreshOnes) {
    const Sheets sheets;
    Stage fresh(Sheets::limited());
    sheets.show(fresh, true, true);
    fresh.render();
    Settings sharp = Sheets::limited();
    sharp.textureMemory = 0;
    Stage whole(sharp);
    sheets.show(whole, true, true);
    whole.render();
    EXPECT_FALSE(sameBits(whole.color(), fresh.color())); // a limit that shows
    sharp.textureFiltering = false;
    for (const std::string mode : {"delta", "uniform"}) {
        Settings before = sharp;
        before.mode = mode;
        Stage edited(before);
        sheets.show(edited, true, false);
        edited.render();
        edited.settings(Sheets::limited(mode));
        edited.render();
        sheets.show(edited, false, true);
        edited.render();
        EXPECT_TRUE(sameBits(edited.color(), fresh.color())) << mode;
        size_t told = 0;
        for (const Message& message : edited.messages())
            told += message.text.find("hipr:textureMemory allows 2 MiB") != std::string::npos;
        EXPECT_EQ(told, 1u) << mode;
    }
}
