// Levels of detail: how they are made, and which of them a ray sees.
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/shading/texels.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/surface_scene.h"

namespace hipr::test {
namespace {

/// All levels made of level 0, whose rows are given from the top.
std::vector<std::vector<glm::vec4>> levelsOf(LevelSize size, uint32_t format, bool weighted,
                                             const std::vector<unsigned char>& rows) {
    const std::vector<LevelSize> sizes = levelSizes(size);
    std::vector<unsigned char> texels(levelBytes(sizes, format));
    LevelBuilder builder(size, format, weighted, 0, texels.data());
    for (uint32_t y = 0; y < size.height; ++y)
        builder.addRow(rows.data() + size_t(y) * size.width * bytesPerTexel(format));
    std::vector<std::vector<glm::vec4>> levels;
    const unsigned char* at = texels.data();
    for (const LevelSize& level : sizes) {
        std::vector<glm::vec4>& values = levels.emplace_back(size_t(level.width) * level.height);
        decodeTexels(format, at, values.size(), values.data());
        at += levelBytes({level}, format);
    }
    return levels;
}

std::vector<unsigned char> floats(const std::vector<glm::vec4>& values) {
    std::vector<unsigned char> texels(values.size() * sizeof(glm::vec4));
    encodeTexels(gpu::TEXEL_RGBA32F, values.data(), values.size(), texels.data());
    return texels;
}

TEST(TextureLevels, SizesHalveDownToOneTexel) {
    const std::vector<LevelSize> expected = {{13, 5}, {6, 2}, {3, 1}, {1, 1}};
    EXPECT_EQ(levelSizes({13, 5}), expected);
    EXPECT_EQ(levelBytes({{13, 5}, {6, 2}}, gpu::TEXEL_RGBA16F), (13u * 5u + 6u * 2u) * 8u);
}

TEST(TextureLevels, AConstantStaysConstant) {
    for (const uint32_t format : {gpu::TEXEL_RGBA8_SRGB, gpu::TEXEL_RGBA8, gpu::TEXEL_RGBA16F})
        for (const LevelSize size : {LevelSize{8, 8}, LevelSize{13, 5}, LevelSize{1, 7}, LevelSize{6, 1}})
            for (int code = 0; code < 256; code += 15) {
                const uint8_t c = uint8_t(code);
                glm::vec4 value;
                const unsigned char texel[4] = {c, uint8_t(255 - c), 77, c};
                decodeTexels(gpu::TEXEL_RGBA8_SRGB, texel, 1, &value);
                std::vector<unsigned char> rows;
                for (uint32_t i = 0; i < size.width * size.height; ++i) {
                    rows.resize(rows.size() + bytesPerTexel(format));
                    encodeTexels(format, &value, 1, &rows[rows.size() - bytesPerTexel(format)]);
                }
                for (const bool weighted : {false, true}) {
                    const auto levels = levelsOf(size, format, weighted, rows);
                    for (size_t level = 1; level < levels.size(); ++level)
                        for (const glm::vec4& v : levels[level])
                            ASSERT_EQ(v, levels[0][0]) << "format " << format << " level " << level;
                }
            }
}

TEST(TextureLevels, TheMeanIsKept) {
    for (const LevelSize size : {LevelSize{16, 8}, LevelSize{13, 5}, LevelSize{1, 9}, LevelSize{31, 33}}) {
        std::vector<glm::vec4> values;
        glm::dvec4 sum(0.0);
        for (uint32_t i = 0; i < size.width * size.height; ++i) {
            values.push_back(glm::vec4(float(i * 37 % 101), float(i), float(i % 2), 1.f) / 100.f);
            sum += glm::dvec4(values.back());
        }
        for (const auto& level : levelsOf(size, gpu::TEXEL_RGBA32F, false, floats(values))) {
            glm::dvec4 mean(0.0);
            for (const glm::vec4& v : level)
                mean += glm::dvec4(v) / double(level.size());
            for (int c = 0; c < 4; ++c)
                EXPECT_NEAR(mean[c], sum[c] / double(values.size()), 1e-5)
                    << size.width << " x " << size.height;
        }
    }
}

/// The bottom left of the picture is the bottom left of every level.
TEST(TextureLevels, RowsStayWhereTheyAre) {
    std::vector<glm::vec4> values(4 * 4, glm::vec4(0.f));
    values[3 * 4] = glm::vec4(4.f); // row 3 from the top
    const auto levels = levelsOf({4, 4}, gpu::TEXEL_RGBA32F, false, floats(values));
    EXPECT_EQ(levels[0][0], glm::vec4(4.f));
    EXPECT_EQ(levels[1][0], glm::vec4(1.f));
    EXPECT_EQ(levels[1][3], glm::vec4(0.f));
    EXPECT_EQ(levels[2][0], glm::vec4(0.25f));
}

TEST(TextureLevels, ColoursCountByTheirAlpha) {
    const glm::vec4 red(1, 0, 0, 1), hidden(0, 1, 0, 0);
    const auto mixed = levelsOf({2, 1}, gpu::TEXEL_RGBA32F, true, floats({red, hidden}));
    EXPECT_NEAR(mixed[1][0].x, 1.f, 1e-3f);
    EXPECT_NEAR(mixed[1][0].y, 0.f, 1e-3f);
    EXPECT_NEAR(mixed[1][0].w, 0.5f, 1e-6f);
    const auto all = levelsOf({2, 1}, gpu::TEXEL_RGBA32F, true, floats({hidden, glm::vec4(0, 0, 1, 0)}));
    EXPECT_NEAR(all[1][0].y, 0.5f, 1e-6f);
    EXPECT_NEAR(all[1][0].w, 0.f, 1e-6f);
    const auto plain = levelsOf({2, 1}, gpu::TEXEL_RGBA32F, false, floats({red, hidden}));
    EXPECT_EQ(plain[1][0], glm::vec4(0.5f, 0.5f, 0.f, 0.5f));
}

/// A texture of 64 x 64 texels whose levels are marked by their greys.
const std::vector<float> Marks = {0.125f, 0.25f, 0.375f, 0.5f, 0.625f, 0.75f, 0.875f};

SurfaceScene markedScene() {
    return sceneWith(matte(textureInput("a.exr")), {{"a.exr", encodeLevels(64, 64, Marks)}});
}

float markSeen(const SurfaceScene& scene, float s = 0.3f, float t = 0.6f) {
    return scene.look({s, t}).diffuse.x;
}

TEST(TextureLevels, ARaySeesTexelsAsLargeAsWhatItCovers) {
    SurfaceScene scene = markedScene();
    EXPECT_FLOAT_EQ(markSeen(scene), Marks[0]);
    for (const float share : {0.f, 0.5f, 0.999f}) {
        scene.levelShare = share;
        for (float level = -2.f; level < 9.f; level += 0.31f) {
            scene.footprint = std::exp2(level) / 64.f; // of the texture, whose side is 1
            const int expected = glm::clamp(int(std::floor(std::max(level, 0.f) + share)), 0, 6);
            EXPECT_FLOAT_EQ(markSeen(scene), Marks[size_t(expected)]) << level << " " << share;
        }
    }
}

TEST(TextureLevels, DependOnTheSizeOnTheSurface) {
    SurfaceScene scene = markedScene();
    scene.footprint = 1.01f * 4.f / 64.f;
    EXPECT_FLOAT_EQ(markSeen(scene), Marks[2]);
    scene.objectToWorld = glm::mat4(glm::mat3(2.f)); // texels twice as wide
    EXPECT_FLOAT_EQ(markSeen(scene), Marks[1]);
    scene.objectToWorld =
        glm::mat4(glm::mat3(2.f, 0, 0, 0, 0.5f, 0, 0, 0, 1.f)); // as large, of another shape
    EXPECT_FLOAT_EQ(markSeen(scene), Marks[2]);
    scene = markedScene();
    scene.footprint = 1.01f * 4.f / 64.f;
    scene.materials[0].diffuseColor.texture.wrapS = WrapMode::Repeat;
    scene.materials[0].diffuseColor.texture.wrapT = WrapMode::Repeat;
    scene.materials[0].diffuseColor.texture.uvTransform = glm::mat3x2(8.f, 0.f, 0.f, 2.f, 0.f, 0.f);
    EXPECT_FLOAT_EQ(markSeen(scene), Marks[4]); // four times as small
    scene.primvars[0].values = {0, 0, 0, 0, 0, 0, 0, 0};
    EXPECT_FLOAT_EQ(markSeen(scene), Marks[0]); // a single texel for all of it
}

TEST(TextureLevels, OpacityAndWhatLightSamplesFindAreReadAtTheirFinest) {
    SurfaceScene scene = markedScene();
    scene.footprint = 1.f;
    scene.materials[0].opacity = textureInput("a.exr", Channel::R);
    const SurfaceOutcome seen = scene.look({0.3f, 0.6f});
    EXPECT_FLOAT_EQ(seen.diffuse.x, Marks[6]);
    EXPECT_FLOAT_EQ(seen.opacity, Marks[0]);
    EXPECT_FLOAT_EQ(seen.presence, Marks[0]);
    scene = markedScene();
    scene.footprint = 1.f;
    scene.materials[0].emissiveColor = textureInput("a.exr");
    EXPECT_FLOAT_EQ(scene.look({0.3f, 0.6f}).emission.x, Marks[6]);
    scene.sampled = true;
    EXPECT_FLOAT_EQ(scene.look({0.3f, 0.6f}).emission.x, Marks[0]);
}

/// Level 1 of four texels is a black and a white one: look-ups between them, and over the edge.
TEST(TextureLevels, WrapAtEveryLevel) {
    const std::vector<uint8_t> row = {0, 0, 0, 0, 0, 0, 255, 255, 255, 255, 255, 255};
    const auto texel = [](int i, WrapMode wrap) {
        if (wrap == WrapMode::Repeat) return i & 1;
        if (wrap == WrapMode::Mirror) return (i >> 1 ^ i) & 1;
        return glm::clamp(i, 0, 1);
    };
    for (const WrapMode wrap : {WrapMode::Black, WrapMode::Repeat, WrapMode::Mirror, WrapMode::Clamp})
        for (const float s : {-1.6f, -0.7f, 0.25f, 0.45f, 0.75f, 0.9f, 1.05f, 2.2f}) {
            MaterialInput input = textureInput("a.png");
            input.texture.wrapS = input.texture.wrapT = wrap;
            SurfaceScene scene = sceneWith(matte(input), {{"a.png", encode8("png", 4, 1, 3, row)}});
            scene.primvars[0].values = {s, 0.5f, s + 1.f, 0.5f, s + 1.f, 1.5f, s, 1.5f};
            scene.footprint = 1.01f; // of 1, with 4 texels: level 1
            const float x = s * 2.f - 0.5f, f = x - std::floor(x);
            const int i = int(std::floor(x));
            const bool cut =
                wrap == WrapMode::Black && (s < 0.f || s > 1.f); // sharp, lest the border creep in
            const float mixed = (1.f - f) * float(texel(i, wrap)) + f * float(texel(i + 1, wrap));
            const float expected = cut ? 0.f : mixed;
            EXPECT_NEAR(scene.look({0.f, 0.f}).diffuse.x, expected, 1e-5f) << int(wrap) << " " << s;
        }
}

TEST(TextureLevels, UdimTilesHaveTheirOwn) {
    const std::vector<float> others = {0.9f, 0.8f, 0.7f};
    SurfaceScene scene =
        sceneWith(matte(textureInput("a.<UDIM>.exr")),
                  {{"a.1001.exr", encodeLevels(64, 64, Marks)}, {"a.1003.exr", encodeLevels(4, 4, others)}});
    scene.primvars[0].values = {0, 0, 4, 0, 4, 1, 0, 1};
    scene.footprint = 1.01f / 64.f; // the set is stretched to a quarter of its width: level 1
    EXPECT_FLOAT_EQ(markSeen(scene, 0.1f, 0.5f), Marks[1]);
    EXPECT_NEAR(markSeen(scene, 0.6f, 0.5f), others[0], 1e-3f);
    scene.footprint = 1.01f / 4.f;
    EXPECT_FLOAT_EQ(markSeen(scene, 0.1f, 0.5f), Marks[5]);
    EXPECT_NEAR(markSeen(scene, 0.6f, 0.5f), others[1], 1e-3f);
}

/// Floats become halves with all their levels.
TEST(TextureLevels, OfFloatFilesAreKeptAsSmallAsTheyFit) {
    for (const float large : {0.75f, 1e6f}) {
        const std::vector<float> row = {0.25f, 0.25f, 0.25f, large, large, large};
        SurfaceScene scene =
            sceneWith(matte(textureInput("a.exr")), {{"a.exr", encodeFloat("exr", 2, 1, 3, row)}});
        EXPECT_NEAR(scene.look({0.25f, 0.5f}).diffuse.x, 0.25f, 1e-6f);
        scene.footprint = 1.01f * std::sqrt(2.f);
        EXPECT_NEAR(markSeen(scene), std::min(0.5f * (0.25f + large), 1.f), 1e-6f);
    }
}

} // namespace
} // namespace hipr::test
