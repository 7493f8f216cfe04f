/// What RenderSettings, RenderProduct and RenderVar prims make hiprrecord write.
#include <gmock/gmock.h>

#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

class RecorderProducts : public RecorderTest {
protected:
    /// Writes a stage over scene() whose /Render scope holds `prims`, and which names /Render/Settings.
    std::string stage(const std::string& prims) const {
        write("shot.usda",
              "#usda 1.0\n(\n    subLayers = [@" + scene() +
                  "@]\n    renderSettingsPrimPath = \"/Render/Settings\"\n)\ndef Scope \"Render\"\n{\n" +
                  prims + "\n}\n");
        return file("shot.usda");
    }
    /// Records with nothing but what the stage says and `arguments`.
    Outcome recorded(const std::string& prims, std::vector<std::string> arguments = {}) const {
        arguments.insert(arguments.begin(), stage(prims));
        return run(command(std::move(arguments)));
    }
    std::string named(const std::string& name) const { return "\"" + file(name) + "\""; }
};

const char* const color = R"(def RenderVar "color" {
    token dataType = "color4f"
    string sourceName = "color"
}
)";
const char* const depth = R"(def RenderVar "depth" {
    token dataType = "float"
    string sourceName = "cameraDepth"
    string driver:parameters:aov:name = "Zcam"
}
)";

std::string settings(const std::string& products, const std::string& more = "") {
    return R"(def RenderSettings "Settings" {
    rel camera = </World/Front>
    uniform int2 resolution = (40, 40)
    int convergedSamplesPerPixel = 4
    rel products = [)" +
           products + "]\n" + more + "\n}\n";
}

std::string product(const std::string& name, const std::string& fileName, const std::string& vars,
                    const std::string& more = "") {
    return "def RenderProduct \"" + name + "\" {\n    token productName = " + fileName +
           "\n    rel orderedVars = [" + vars + "]\n" + more + "\n}\n";
}

TEST_F(RecorderProducts, WriteTheirVarsUnderTheirNames) {
    const Outcome outcome = recorded(
        std::string(color) + depth + product("A", named("a.exr"), "</Render/color>, </Render/depth>") +
        product("B", named("b.png"), "</Render/color>") + settings("</Render/A>, </Render/B>"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(files(), UnorderedElementsAre("a.exr", "b.png", "shot.usda"));
    const ImageFile a(file("a.exr"));
    EXPECT_EQ(a.spec().width, 40);
    EXPECT_THAT(a.spec().channelnames, UnorderedElementsAre("R", "G", "B", "A", "Zcam.Z"));
    EXPECT_EQ(colourAt(a, redSpot), "red");
    EXPECT_NEAR(a.at("Zcam.Z", redSpot.x, redSpot.y), 10.f, 1e-4f);
    EXPECT_EQ(a.spec().get_int_attribute("hipr:samples"), 4) << "set by the prim";
    EXPECT_GT(ImageFile(file("b.png")).at("R", redSpot.x, redSpot.y), 0.95f);
}

// Products of another camera or size are recorded after the first.
TEST_F(RecorderProducts, MayHaveCamerasAndSizesOfTheirOwn) {
    const Outcome outcome =
        recorded(std::string(color) + product("A", named("front.exr"), "</Render/color>") +
                 product("B", named("side.exr"), "</Render/color>",
                         "    rel camera = </World/Side>\n    uniform int2 resolution = (32, 16)") +
                 settings("</Render/A>, </Render/B>"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(ImageFile(file("front.exr")).spec().get_string_attribute("hipr:camera"), "/World/Front");
    const ImageFile side(file("side.exr"));
    EXPECT_EQ(side.spec().get_string_attribute("hipr:camera"), "/World/Side");
    EXPECT_EQ(side.spec().width, 32);
    EXPECT_EQ(side.spec().height, 16);
}

TEST_F(RecorderProducts, MayHaveANameForEachFrame) {
    const std::string animated =
        "def RenderProduct \"A\" {\n    token productName.timeSamples = { 1: " + named("one.exr") +
        ", 2: " + named("two.exr") + " }\n    rel orderedVars = [</Render/color>]\n}\n";
    const Outcome outcome = recorded(color + animated + settings("</Render/A>"), {"--frames", "1:2"});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(files(), UnorderedElementsAre("one.exr", "shot.usda", "two.exr"));
    const Outcome still =
        recorded(color + product("A", named("a.exr"), "</Render/color>") + settings("</Render/A>"),
                 {"--frames", "1:2"});
    EXPECT_NE(still.code, 0);
    EXPECT_THAT(still.text, HasSubstr("placeholder"));
}

// expandAperture shows all of the camera's square in a wide picture, adjustApertureHeight cuts its top and
// bottom off.
TEST_F(RecorderProducts, FitTheCameraByTheirPolicy) {
    const std::string wide =
        "    uniform int2 resolution = (64, 32)\n    uniform token aspectRatioConformPolicy = ";
    const Outcome outcome = recorded(
        std::string(color) + product("A", named("all.exr"), "</Render/color>", wide + "\"expandAperture\"") +
        product("B", named("cut.exr"), "</Render/color>", wide + "\"adjustApertureHeight\"") +
        settings("</Render/A>, </Render/B>"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(colourAt(ImageFile(file("all.exr")), blueSpot), "blue");
    EXPECT_EQ(colourAt(ImageFile(file("cut.exr")), blueSpot), "none");
    EXPECT_EQ(colourAt(ImageFile(file("cut.exr")), redSpot), "red");
}

// A data window is a part of the picture; pixels that are twice as wide as high show the square in half the
// columns.
TEST_F(RecorderProducts, MayBeAPartOfThePictureOrHaveWidePixels) {
    const Outcome outcome =
        recorded(std::string(color) +
                 product("A", named("part.exr"), "</Render/color>",
                         "    uniform float4 dataWindowNDC = (0, 0.25, 0.5, 0.75)") +
                 product("B", named("wide.exr"), "</Render/color>",
                         "    uniform float pixelAspectRatio = 2\n    uniform int2 resolution = (20, 40)") +
                 product("C", named("fit.exr"), "</Render/color>",
                         "    uniform int2 resolution = (20, 40)\n"
                         "    uniform token aspectRatioConformPolicy = \"adjustPixelAspectRatio\"") +
                 settings("</Render/A>, </Render/B>, </Render/C>"));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const ImageFile part(file("part.exr"));
    EXPECT_EQ(part.spec().width, 20);
    EXPECT_EQ(part.spec().height, 20);
    EXPECT_EQ(part.spec().y, 10);
    EXPECT_EQ(part.spec().full_width, 40);
    EXPECT_EQ(colourAt(part, {redSpot.x * 2, 0.5}), "red");
    for (const char* const name : {"wide.exr", "fit.exr"}) {
        const ImageFile wide(file(name));
        EXPECT_NEAR(wide.spec().get_float_attribute("PixelAspectRatio"), 2.f, 1e-5f) << name;
        EXPECT_EQ(colourAt(wide, redSpot), "red") << name;
        EXPECT_EQ(colourAt(wide, greenSpot), "green") << name;
        EXPECT_EQ(colourAt(wide, blueSpot), "blue") << name;
    }
}

/// How many pixels are covered in part.
size_t blurredPixels(const ImageFile& picture) {
    const std::vector<float> alpha = picture.values("A");
    return size_t(std::count_if(alpha.begin(), alpha.end(), [](float a) { return a > 0.2f && a < 0.8f; }));
}

TEST_F(RecorderProducts, MaySwitchMotionBlurOff) {
    const std::string moving = R"(def Cube "Moving" {
    double3 xformOp:translate.timeSamples = { 0: (96, 0, 0), 1: (104, 0, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Open" {
    double shutter:open = 0
    double shutter:close = 1
    double3 xformOp:translate = (100, 0, 30)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
)";
    const std::string view = "    rel camera = </Render/Open>\n";
    const Outcome outcome =
        recorded(moving + color + product("A", named("blurred.exr"), "</Render/color>", view) +
                     product("B", named("sharp.exr"), "</Render/color>",
                             view + "    uniform bool instantaneousShutter = 1") +
                     product("C", named("still.exr"), "</Render/color>",
                             view + "    uniform bool disableMotionBlur = 1") +
                     settings("</Render/A>, </Render/B>, </Render/C>"),
                 {"--frames", "0"});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const size_t blurred = blurredPixels(ImageFile(file("blurred.exr"))); // the others have edges
    EXPECT_GT(blurred, 100u);
    EXPECT_LT(blurredPixels(ImageFile(file("sharp.exr"))), blurred / 3);
    EXPECT_LT(blurredPixels(ImageFile(file("still.exr"))), blurred / 3);
}

TEST_F(RecorderProducts, MaySwitchDepthOfFieldOff) {
    const std::string blurry = R"(def Cube "Far" {
    double size = 4
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Near" {
    float fStop = 10
    float focalLength = 50
    float focusDistance = 5
    double3 xformOp:translate = (100, 0, 30)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
)";
    const std::string view = "    rel camera = </Render/Near>\n";
    const Outcome outcome =
        recorded(blurry + color + product("A", named("blurred.exr"), "</Render/color>", view) +
                     product("B", named("sharp.exr"), "</Render/color>",
                             view + "    uniform bool disableDepthOfField = 1") +
                     settings("</Render/A>, </Render/B>"),
                 {});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const size_t blurred = blurredPixels(ImageFile(file("blurred.exr")));
    EXPECT_GT(blurred, 100u);
    EXPECT_LT(blurredPixels(ImageFile(file("sharp.exr"))), blurred / 3);
}

TEST_F(RecorderProducts, TheCommandLineWins) {
    const std::string prims =
        color + product("A", named("a.exr"), "</Render/color>") +
        settings("</Render/A>", "    token[] includedPurposes = [\"default\", \"guide\"]");
    ASSERT_EQ(recorded(prims, {"--size", "20x20", "--samples", "2", "--camera", "Side"}).code, 0);
    const ImageFile small(file("a.exr"));
    EXPECT_EQ(small.spec().width, 20);
    EXPECT_EQ(small.spec().get_int_attribute("hipr:samples"), 2);
    EXPECT_EQ(small.spec().get_string_attribute("hipr:camera"), "/World/Side");

    ASSERT_EQ(recorded(prims).code, 0);
    const auto covered = [&] { return ImageFile(file("a.exr")).at("A", guideSpot.x, guideSpot.y); };
    EXPECT_EQ(covered(), 1.f) << "includedPurposes";
    ASSERT_EQ(recorded(prims, {"--purposes", "render"}).code, 0);
    EXPECT_EQ(covered(), 0.f);

    // With an output of its own, the named settings still choose the view.
    ASSERT_EQ(recorded(prims, {"-o", file("own.exr"), "--render-settings", "/Render/Settings"}).code, 0);
    EXPECT_EQ(ImageFile(file("own.exr")).spec().width, 40);
}

TEST_F(RecorderProducts, WhatCannotBeDoneIsSaid) {
    const std::string a = product("A", named("a.exr"), "</Render/color>");
    EXPECT_THAT(recorded("def Scope \"Settings\" {\n}").text, HasSubstr("no output"));
    EXPECT_THAT(recorded(settings("")).text, HasSubstr("no product"));
    EXPECT_THAT(recorded(settings("</Render/Gone>")).text, HasSubstr("/Render/Gone"));
    EXPECT_THAT(recorded(color + a + settings("</Render/A>"), {"--render-settings", "/Nobody"}).text,
                HasSubstr("/Nobody"));
    EXPECT_THAT(recorded(a + settings("</Render/A>")).text, HasSubstr("/Render/color"))
        << "the var is missing";
    EXPECT_THAT(recorded(color + product("A", "\"\"", "</Render/color>") + settings("</Render/A>")).text,
                HasSubstr("productName"));
    EXPECT_THAT(
        recorded(color + product("A", named("a.tga"), "</Render/color>") + settings("</Render/A>")).text,
        HasSubstr("a.tga"));
    EXPECT_THAT(recorded(color + a + settings("</Render/A>"), {"--aovs", "depth"}).text, HasSubstr("--aovs"));

    const Outcome odd = recorded(color + a +
                                 product("Deep", named("deep.exr"), "</Render/color>",
                                         "    uniform token productType = \"deepRaster\"") +
                                 settings("</Render/A>, </Render/Deep>",
                                          "    uniform float pixelAspectRatio = -2\n"
                                          "    int hipr:maxDpeth = 3\n    int other:thing = 1"));
    EXPECT_EQ(odd.code, 0);
    EXPECT_THAT(odd.text, AllOf(HasSubstr("deepRaster"), HasSubstr("pixelAspectRatio"),
                                HasSubstr("hipr:maxDpeth"), testing::Not(HasSubstr("other:thing"))));
    EXPECT_THAT(files(), UnorderedElementsAre("a.exr", "shot.usda"));
}

} // namespace
} // namespace hipr::test
