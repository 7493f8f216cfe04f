// Texture files that change while they are in use.
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include "testenv/render/picture_file.h"
#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

MaterialInput textured(const PictureFile& file) {
    MaterialInput input;
    input.source = MaterialInput::Source::Texture;
    input.texture.path = file.path();
    input.texture.colorSpace = "raw";
    return input;
}

/// A sheet that is painted, glows and is displaced by pictures, under a dome that is one too.
void fill(Stage& stage, const PictureFile& paint, const PictureFile& glow, const PictureFile& height,
          const PictureFile& sky) {
    MaterialDesc material = matte(glm::vec3(0.f));
    material.diffuseColor = textured(paint);
    material.emissiveColor = textured(glow);
    material.displacement.amount = textured(height);
    material.displacement.amount.channel = Channel::R;
    stage.add(quadMesh({{"st", Interpolation::Vertex, 2, {0, 0, 1, 0, 1, 1, 0, 1}}}), material);
    LightDesc dome;
    dome.name = "dome";
    dome.kind = LightKind::Dome;
    dome.texture = sky.path();
    stage.add(dome);
    stage.edit.setCamera(lookAt({0.5, 1, 2}, {0, 0, 0.2}));
    stage.film(32, 32);
}

bool equal(const ColorPicture& a, const ColorPicture& b) {
    return a.values.size() == b.values.size() &&
           std::memcmp(a.values.data(), b.values.data(), a.values.size() * sizeof(glm::vec4)) == 0;
}

} // namespace

TEST(TextureReload, GivesThePictureOfAFreshStart) {
    const auto rising = [](uint32_t x, uint32_t y) { return 16 * x + y; };
    const auto falling = [](uint32_t x, uint32_t y) { return 200 - 20 * y - x; };
    const PictureFile paint("paint", 8, rising), glow("glow", 8, rising), height("height", 8, rising),
        sky("sky", 8, rising);
    const PictureFile* const files[] = {&paint, &glow, &height, &sky};
    Stage edited(withSamples(4));
    fill(edited, paint, glow, height, sky);
    edited.render();
    for (const PictureFile* file : files) {
        const ColorPicture before = edited.color();
        file->write(6, falling);
        EXPECT_FALSE(edited.renderer->reloadTextures().empty());
        edited.render();
        Stage fresh(withSamples(4));
        fill(fresh, paint, glow, height, sky);
        fresh.render();
        EXPECT_FALSE(equal(before, edited.color())) << file->path();
        EXPECT_TRUE(equal(fresh.color(), edited.color())) << file->path();
    }
}

/// Of a light, and of a mesh that is one.
TEST(TextureReload, ReadsLightProfilesToo) {
    const std::string path = ::testing::TempDir() + "hipr_reload.ies";
    const auto write = [&](const char* candela) {
        std::ofstream(path) << "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n"
                            << candela << '\n';
    };
    const auto setUp = [&](Stage& stage, bool mesh) {
        SurfaceLight shaped;
        shaped.shaping.iesFile = path;
        LightDesc ball;
        ball.name = "ball";
        ball.shaping = shaped.shaping;
        ball.transform = glm::translate(glm::dmat4(1), glm::dvec3(0, 0, 2));
        ball.visible = !mesh;
        stage.add(ball);
        ObjectDesc desc;
        desc.light = std::make_shared<const SurfaceLight>(shaped);
        MaterialDesc glow = matte(glm::vec3(0.f));
        glow.emissiveColor = constantColor(glm::vec3(1.f));
        if (mesh) stage.add(quadMesh(), glow, {translation(0, 0, 2)}, desc);
        stage.add(quadMesh(), matte(glm::vec3(0.5f)));
        stage.edit.setCamera(lookAt({0.5, 1, 2}, {0, 0, 0}));
        stage.film(16, 16);
        stage.render();
    };
    for (const bool mesh : {false, true}) {
        SCOPED_TRACE(mesh);
        write("1 1 1");
        Stage edited(withSamples(4));
        setUp(edited, mesh);
        const ColorPicture before = edited.color();
        write("5 2 1");
        EXPECT_FALSE(edited.renderer->reloadTextures().empty());
        edited.render();
        Stage fresh(withSamples(4));
        setUp(fresh, mesh);
        EXPECT_FALSE(equal(before, edited.color()));
        EXPECT_TRUE(equal(fresh.color(), edited.color()));
    }
}

TEST(TextureReload, ChangesNothingWithoutTextures) {
    Stage stage(withSamples(4));
    stage.add(quadMesh(), matte(glm::vec3(0.5f)));
    stage.edit.setCamera(lookAt({0, 0, 2}, {0, 0, 0}));
    stage.film(16, 16);
    stage.render();
    const ColorPicture before = stage.color();
    EXPECT_TRUE(stage.renderer->reloadTextures().empty());
    EXPECT_TRUE(stage.renderer->progress().converged);
    stage.render();
    EXPECT_TRUE(equal(before, stage.color()));
}
