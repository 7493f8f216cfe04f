#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shaders/shared/material.h"
#include "testenv/unit/shading/picture.h"

namespace hipr::test {
namespace {

std::shared_ptr<const ColorManager> color() {
    static const auto manager = ColorManager::create({});
    return manager;
}

Image decode(const Bytes& bytes, const std::string& path, const std::string& space = "auto") {
    Image image;
    std::string error;
    const auto file = ImageFile::open(path, serve({{path, bytes}}), error);
    EXPECT_TRUE(file && decodeImage(*file, space, *color(), image, error)) << path << ": " << error;
    return image;
}

void expectTexel(const Image& image, uint32_t x, uint32_t y, const glm::vec4& value,
                 float tolerance = 1e-6f) {
    const glm::vec4 texel = image.texel(x, y);
    for (int c = 0; c < 4; ++c)
        EXPECT_NEAR(texel[c], value[c], tolerance) << "texel " << x << " " << y << " channel " << c;
}

double srgb(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

TEST(Image, EightBitColourIsSrgbAndBottomUp) {
    // Top row red, green; bottom row blue, grey.
    const std::vector<uint8_t> pixels = {255, 0, 0, 0, 255, 0, 0, 0, 255, 128, 128, 128};
    for (const Image& image :
         {decode(encode8("png", 2, 2, 3, pixels), "a.png"), decode(encodePpm(2, 2, pixels), "a.ppm"),
          decode(encode8("tif", 2, 2, 3, pixels), "dir.x/scene.usdz[textures/a.tif]")}) {
        EXPECT_EQ(image.format, gpu::TEXEL_RGBA8_SRGB);
        EXPECT_TRUE(image.opaque);
        expectTexel(image, 0, 1, {1, 0, 0, 1});
        expectTexel(image, 1, 1, {0, 1, 0, 1});
        expectTexel(image, 0, 0, {0, 0, 1, 1});
        const float grey = float(srgb(128 / 255.0));
        expectTexel(image, 1, 0, {grey, grey, grey, 1});
    }
}

TEST(Image, ChannelsSpreadAsUsdUVTextureSays) {
    expectTexel(decode(encode8("png", 1, 1, 1, {51}), "a.png"), 0, 0, {0.2f, 0.2f, 0.2f, 1.f});
    const Image two = decode(encode8("png", 1, 1, 2, {51, 102}), "a.png");
    expectTexel(two, 0, 0, {0.2f, 0.2f, 0.2f, 0.4f});
    EXPECT_FALSE(two.opaque);
    // Unassociated: a transparent red stays red.
    expectTexel(decode(encode8("png", 1, 1, 4, {255, 0, 0, 51}), "a.png", "raw"), 0, 0,
                {1.f, 0.f, 0.f, 0.2f});
}

TEST(Image, ColourSpaces) {
    const Bytes png = encode8("png", 1, 1, 3, {128, 64, 32});
    EXPECT_EQ(decode(png, "a.png", "raw").format, gpu::TEXEL_RGBA8);
    expectTexel(decode(png, "a.png", "raw"), 0, 0, {128 / 255.f, 64 / 255.f, 32 / 255.f, 1.f});
    EXPECT_EQ(decode(png, "a.png", "srgb_texture").format, gpu::TEXEL_RGBA8_SRGB);
    EXPECT_EQ(decode(encode8("png", 1, 1, 1, {128}), "a.png", "sRGB").format, gpu::TEXEL_RGBA8_SRGB);
    const Image acescg = decode(png, "a.png", "ACEScg");
    EXPECT_EQ(acescg.format, gpu::TEXEL_RGBA16F);
    EXPECT_GT(acescg.texel(0, 0).x, 128 / 255.f); // AP1 red lies outside Rec.709
    // 16 bit counts as linear for "auto", and takes the sRGB curve on request.
    const Bytes deep = encodeFloat("png", 1, 1, 3, {0.5f, 0.25f, 1.f});
    expectTexel(decode(deep, "a.png"), 0, 0, {0.5f, 0.25f, 1.f, 1.f}, 1e-3f);
    expectTexel(decode(deep, "a.png", "sRGB"), 0, 0, {float(srgb(0.5)), float(srgb(0.25)), 1.f, 1.f}, 1e-3f);
}

TEST(Image, FloatsAreHalvesUntilTheyOverflow) {
    const Image half = decode(encodeFloat("exr", 2, 1, 3, {0.5f, 2.f, 60000.f, 1e-3f, 0.f, 1.f}), "a.exr");
    EXPECT_EQ(half.format, gpu::TEXEL_RGBA16F);
    expectTexel(half, 0, 0, {0.5f, 2.f, 60000.f, 1.f}, 16.f);
    const Image full = decode(encodeFloat("exr", 1, 1, 3, {0.5f, 2.f, 1e6f}), "a.exr");
    EXPECT_EQ(full.format, gpu::TEXEL_RGBA32F);
    expectTexel(full, 0, 0, {0.5f, 2.f, 1e6f, 1.f});
    const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
    const Image odd = decode(encodeFloat("exr", 1, 1, 3, {nan, inf, -inf}), "a.exr");
    expectTexel(odd, 0, 0, {0.f, 65504.f, -65504.f, 1.f});
}

TEST(Image, WrapModesComeFromMetadata) {
    const Image image = decode(encodeFloat("exr", 1, 1, 3, {1, 1, 1}, "periodic,mirror"), "a.exr");
    EXPECT_EQ(image.wrapS, WrapMode::Repeat);
    EXPECT_EQ(image.wrapT, WrapMode::Mirror);
    EXPECT_EQ(decode(encodeFloat("exr", 1, 1, 3, {1, 1, 1}), "a.exr").wrapS, WrapMode::Black);
}

TEST(Image, BrokenFilesGiveAReason) {
    Bytes cut = encode8("png", 64, 64, 3, std::vector<uint8_t>(64 * 64 * 3, 200));
    cut.resize(cut.size() / 2);
    const Bytes noise(1000, 0x5a);
    Bytes cutExr = encodeFloat("exr", 8, 8, 3, std::vector<float>(8 * 8 * 3, 1.f));
    cutExr.resize(200);
    Bytes huge = encodePpm(60000, 60000, {1, 2, 3}); // a header that asks for 10 GB
    const Files files = {{"huge.ppm", huge},   {"cut.png", cut},     {"cut.exr", cutExr},
                         {"noise.png", noise}, {"noise.exr", noise}, {"noise.xyz", noise},
                         {"noise", noise},     {"noise.jpg", noise}, {"noise.hdr", noise},
                         {"noise.tif", noise}};
    for (const auto& [path, bytes] : files) {
        Image image;
        std::string error;
        const auto file = ImageFile::open(path, serve(files), error);
        EXPECT_FALSE(file && decodeImage(*file, "auto", *color(), image, error)) << path;
        EXPECT_FALSE(error.empty()) << path;
        EXPECT_THAT(error,
                    testing::Not(testing::AnyOf(testing::HasSubstr("\n"), testing::HasSubstr("hipr"))));
    }
}

} // namespace
} // namespace hipr::test
