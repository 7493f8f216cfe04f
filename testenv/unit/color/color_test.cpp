#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "renderer/color/view.h"

namespace hipr::test {
namespace {

using ::testing::HasSubstr;

/// Sets $OCIO while it lives.
class OcioVariable {
public:
    explicit OcioVariable(const std::string& value) { setenv("OCIO", value.c_str(), 1); }
    ~OcioVariable() { unsetenv("OCIO"); }
};

struct Log {
    std::vector<std::string> texts;
    MessageSink sink() {
        return [this](Severity, const std::string&, const std::string& text) { texts.push_back(text); };
    }
};

class Color : public ::testing::Test {
protected:
    Color() { unsetenv("OCIO"); }

    /// A configuration file with the given text; removed at the end.
    std::string file(const std::string& text) {
        const auto path = std::filesystem::path(::testing::TempDir()) /
                          ("hipr-color-" + std::to_string(_files.size()) + ".ocio");
        std::ofstream(path) << text;
        _files.push_back(path);
        return path.string();
    }
    ~Color() override {
        for (const auto& path : _files)
            std::filesystem::remove(path);
    }

private:
    std::vector<std::filesystem::path> _files;
};

double srgbDecode(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

double srgbEncode(double c) {
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

std::vector<float> converted(const ColorManager& color, const std::string& space, std::vector<float> rgba) {
    EXPECT_EQ(color.transfer(space, false, 3), TexelTransfer::Convert) << space;
    color.convert(space, rgba.data(), rgba.size() / 4);
    return rgba;
}

TEST_F(Color, SourceColorSpaces) {
    Log log;
    const auto color = ColorManager::create(log.sink());
    EXPECT_EQ(color->transfer("auto", true, 3), TexelTransfer::Srgb);
    EXPECT_EQ(color->transfer("auto", true, 4), TexelTransfer::Srgb);
    EXPECT_EQ(color->transfer("auto", true, 1), TexelTransfer::Linear);
    EXPECT_EQ(color->transfer("auto", false, 3), TexelTransfer::Linear);
    EXPECT_EQ(color->transfer("raw", true, 3), TexelTransfer::Linear);
    EXPECT_EQ(color->transfer("sRGB", true, 1), TexelTransfer::Srgb);
    EXPECT_EQ(color->transfer("lin_rec709", true, 3), TexelTransfer::Linear);
    EXPECT_EQ(color->transfer("data", true, 3), TexelTransfer::Linear);
    for (const char* space :
         {"ACEScg", "lin_ap1", "adobergb", "lin_displayp3", "srgb_displayp3", "g22_rec709", "g18_rec709",
          "rec709_display", "lin_rec2020", "ACES2065-1", "g22_ap1", "srgb_ap1", "lin_adobergb"})
        EXPECT_EQ(color->transfer(space, true, 3), TexelTransfer::Convert) << space;
    EXPECT_TRUE(log.texts.empty());
}

TEST_F(Color, UnknownSpacesAreToldOnceAndCountAsAuto) {
    Log log;
    const auto color = ColorManager::create(log.sink());
    EXPECT_EQ(color->transfer("nonsense", true, 3), TexelTransfer::Srgb);
    EXPECT_EQ(color->transfer("nonsense", false, 3), TexelTransfer::Linear);
    ASSERT_EQ(log.texts.size(), 1u);
    EXPECT_THAT(log.texts[0], HasSubstr("\"nonsense\""));
}

TEST_F(Color, WhiteStaysWhiteAndPrimariesMove) {
    const auto color = ColorManager::create({});
    for (const char* space :
         {"ACEScg", "ACES2065-1", "lin_displayp3", "lin_rec2020", "adobergb", "srgb_displayp3"}) {
        const std::vector<float> white = converted(*color, space, {1.f, 1.f, 1.f, 0.3f});
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(white[size_t(c)], 1.f, 2e-3f) << space;
        EXPECT_EQ(white[3], 0.3f);
    }
    // The AP1 red primary in linear Rec.709, Bradford-adapted (ACES documents: 1.70505, -0.13026, -0.02400).
    const std::vector<float> red = converted(*color, "ACEScg", {1.f, 0.f, 0.f, 1.f});
    EXPECT_NEAR(red[0], 1.70505f, 1e-3f);
    EXPECT_NEAR(red[1], -0.13026f, 1e-3f);
    EXPECT_NEAR(red[2], -0.02400f, 1e-3f);
    EXPECT_NEAR(converted(*color, "g22_rec709", {0.5f, 0.5f, 0.5f, 1.f})[0], std::pow(0.5, 2.2), 1e-4);
    EXPECT_NEAR(converted(*color, "srgb_displayp3", {0.5f, 0.5f, 0.5f, 1.f})[0], srgbDecode(0.5), 1e-4);
}

TEST_F(Color, PlainSrgbView) {
    std::string error;
    const auto view = ViewTransform::create(ColorManager::create({}), {}, &error);
    ASSERT_TRUE(view) << error;
    std::vector<float> rgba;
    for (int i = 0; i < 3000; ++i)
        rgba.insert(rgba.end(), {float(i) / 2000.f, 0.18f, -1.f, 1.f});
    std::vector<uint8_t> out(rgba.size());
    view->apply(rgba.data(), out.data(), rgba.size() / 4);
    for (size_t i = 0; i < out.size(); i += 4) {
        const double exact = 255.0 * std::min(srgbEncode(double(rgba[i])), 1.0);
        ASSERT_NEAR(out[i], exact, 0.51) << rgba[i];
        ASSERT_EQ(out[i + 1], 118);
        ASSERT_EQ(out[i + 2], 0);
        ASSERT_EQ(out[i + 3], 255);
    }
}

TEST_F(Color, AlphaIsUnassociatedAndOddValuesSurvive) {
    std::string error;
    const auto view = ViewTransform::create(ColorManager::create({}), {"", "", 1.f}, &error);
    ASSERT_TRUE(view) << error;
    const float nan = std::nanf(""), inf = std::numeric_limits<float>::infinity();
    const std::vector<float> rgba = {0.045f, 0.045f, 0.045f, 0.5f, nan, inf, -inf, nan, 0.09f, 0.f, 0.f, 0.f};
    std::vector<uint8_t> out(rgba.size());
    view->apply(rgba.data(), out.data(), 3);
    EXPECT_EQ(out[0], 118); // 0.045 / 0.5 * 2^1 = 0.18
    EXPECT_EQ(out[3], 128);
    EXPECT_EQ(out[4], 0);
    EXPECT_EQ(out[5], 255);
    EXPECT_EQ(out[6], 0);
    EXPECT_EQ(out[7], 0);
    EXPECT_EQ(out[8], 118);
    EXPECT_EQ(out[11], 0);
}

TEST_F(Color, AcesViewCompressesHighlights) {
    std::string error;
    const auto view = ViewTransform::create(ColorManager::create({}), {"sRGB", "ACES", 0.f}, &error);
    ASSERT_TRUE(view) << error;
    const std::vector<float> rgba = {0.18f, 0.18f, 0.18f, 1.f, 2.f, 2.f, 2.f, 1.f, 4.f, 4.f, 4.f, 1.f};
    std::vector<uint8_t> out(rgba.size());
    view->apply(rgba.data(), out.data(), 3);
    EXPECT_NEAR(out[0], 90, 4); // mid grey of the ACES SDR output transform: 10 nits of 100
    EXPECT_NEAR(out[0], out[1], 1);
    EXPECT_LT(out[4], 255);
    EXPECT_GT(out[8], out[4]);
}

TEST_F(Color, UnknownViewsListWhatExists) {
    const auto color = ColorManager::create({});
    std::string error;
    EXPECT_FALSE(ViewTransform::create(color, {"sRGB", "Nothing", 0.f}, &error));
    EXPECT_THAT(error, HasSubstr("\"sRGB/ACES\""));
    EXPECT_THAT(ViewTransform::names(*color), ::testing::Contains("sRGB/sRGB"));
}

TEST_F(Color, BrokenConfigurationsAreToldOnce) {
    for (const std::string& path : {std::string("/nonexistent/config.ocio"), file("not a configuration"),
                                    file("ocio_profile_version: 2\nroles: {default: a}\ncolorspaces:\n"
                                         "  - !<ColorSpace> {name: a}\n")}) {
        const OcioVariable variable(path);
        Log log;
        const auto color = ColorManager::create(log.sink());
        ASSERT_EQ(log.texts.size(), 1u) << path;
        EXPECT_THAT(log.texts[0], HasSubstr(path));
        EXPECT_EQ(color->transfer("ACEScg", true, 3), TexelTransfer::Convert);
        std::string error;
        EXPECT_TRUE(ViewTransform::create(color, {}, &error)) << error;
    }
}

/// A configuration whose reference is ACES2065-1 and that does not know linear Rec.709: the way leads over
/// aces_interchange, and our spaces are not its spaces.
TEST_F(Color, ForeignConfigurationsConnectThroughAces) {
    const OcioVariable variable(file(R"(ocio_profile_version: 2
strictparsing: true
roles: {default: reference, aces_interchange: reference}
displays:
  Projector:
    - !<View> {name: Plain, colorspace: gamma}
colorspaces:
  - !<ColorSpace> {name: reference}
  - !<ColorSpace>
    name: studio
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}
  - !<ColorSpace>
    name: gamma
    from_scene_reference: !<ExponentTransform> {value: 2, direction: inverse}
)"));
    Log log;
    const auto color = ColorManager::create(log.sink());
    EXPECT_TRUE(log.texts.empty()) << log.texts[0];
    const std::vector<float> red = converted(*color, "studio", {1.f, 0.f, 0.f, 1.f});
    EXPECT_NEAR(red[0], 1.70505f, 2e-3f);
    EXPECT_NEAR(red[1], -0.13026f, 2e-3f);
    std::string error;
    const auto view = ViewTransform::create(color, {}, &error);
    ASSERT_TRUE(view) << error;
    const std::vector<float> rgba = {0.25f, 0.25f, 0.25f, 1.f};
    std::vector<uint8_t> out(4);
    view->apply(rgba.data(), out.data(), 1);
    EXPECT_NEAR(out[0], 127.5, 1.5); // white is preserved, gamma 2
}

TEST_F(Color, ManyThreadsShareOneManager) {
    const auto color = ColorManager::create({});
    std::string error;
    const auto view = ViewTransform::create(color, {}, &error);
    std::vector<std::thread> threads;
    std::atomic<int> wrong{0};
    for (int t = 0; t < 4; ++t)
        threads.emplace_back([&] {
            for (int i = 0; i < 50; ++i) {
                if (color->transfer(i % 2 ? "ACEScg" : "adobergb", true, 3) != TexelTransfer::Convert)
                    ++wrong;
                std::vector<float> rgba(400, 0.18f);
                color->convert("ACEScg", rgba.data(), 100);
                std::vector<float> grey(400, 1.f);
                for (size_t p = 0; p < 400; ++p)
                    if (p % 4 != 3) grey[p] = 0.18f;
                std::vector<uint8_t> out(400);
                view->apply(grey.data(), out.data(), 100);
                if (out[0] != 118 || std::abs(rgba[0] - 0.18f) > 1e-3f) ++wrong;
            }
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(wrong, 0);
}

} // namespace
} // namespace hipr::test
