/// What hiprrecord writes: channels, metadata, frames, cameras, visibility.
#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <gmock/gmock.h>
#include <map>
#include <nlohmann/json.hpp>

#include "pxr/usd/usd/zipFile.h"
#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr uint32_t noId = 0xffffffffu;

class RecorderPictures : public RecorderTest {
protected:
    /// Records to an EXR and reads it back.
    ImageFile picture(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"-o", file("a.exr")});
        const Outcome outcome = record(std::move(arguments));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        return ImageFile(file("a.exr"));
    }
};

TEST_F(RecorderPictures, ColourIsLinearAndTheTopRowComesFirst) {
    const ImageFile image = picture({});
    EXPECT_EQ(colourAt(image, redSpot), "red");
    EXPECT_EQ(colourAt(image, greenSpot), "green");
    EXPECT_EQ(colourAt(image, blueSpot), "blue");
    EXPECT_EQ(colourAt(image, emptySpot), "none");
    EXPECT_EQ(image.at("A", redSpot.x, redSpot.y), 1.f);
    EXPECT_EQ(image.at("A", emptySpot.x, emptySpot.y), 0.f);
    if (rendererUnderTest() == "HiPR") {
        EXPECT_NEAR(image.at("R", redSpot.x, redSpot.y), 1.f, 1e-5f) << "emits radiance 1";
    }
}

TEST_F(RecorderPictures, AovsBecomeLayersOfTheRightType) {
    const ImageFile image = picture({"--aovs", "color,depth,cameraDepth,normal,primId,instanceId,elementId"});
    for (const char* channel :
         {"R", "G", "B", "A", "depth.Z", "cameraDepth.Z", "normal.X", "normal.Y", "normal.Z"})
        EXPECT_EQ(image.channelType(channel), "float") << channel;
    for (const char* channel : {"primId.I", "instanceId.I", "elementId.I"})
        EXPECT_EQ(image.channelType(channel), "uint") << channel;

    // The camera stands at z = 10; the clipping range is 1 to 20.
    if (rendererUnderTest() == "HiPR") {
        EXPECT_NEAR(image.at("cameraDepth.Z", redSpot.x, redSpot.y), 10.f, 1e-4f);
        EXPECT_NEAR(image.at("cameraDepth.Z", blueSpot.x, blueSpot.y), 9.f, 1e-4f);
        EXPECT_NEAR(image.at("depth.Z", redSpot.x, redSpot.y), 9.f / 19.f, 1e-5f);
        EXPECT_EQ(image.at("cameraDepth.Z", emptySpot.x, emptySpot.y), 0.f);
    }
    EXPECT_EQ(image.at("depth.Z", emptySpot.x, emptySpot.y), 1.f);
    EXPECT_NEAR(image.at("normal.Z", redSpot.x, redSpot.y), 1.f, 1e-5f);

    const uint32_t red = image.idAt("primId.I", redSpot.x, redSpot.y);
    const uint32_t green = image.idAt("primId.I", greenSpot.x, greenSpot.y);
    EXPECT_NE(red, noId);
    EXPECT_NE(green, noId);
    EXPECT_NE(red, green);
    EXPECT_EQ(image.idAt("primId.I", emptySpot.x, emptySpot.y), noId);
    EXPECT_EQ(image.idAt("elementId.I", redSpot.x, redSpot.y), 0u);
}

/// The bits of a float whose channel says what is seen at a place.
uint32_t matteAt(const ImageFile& image, const std::string& channel, Spot spot) {
    const float id = image.at(channel, spot.x, spot.y);
    uint32_t bits;
    std::memcpy(&bits, &id, sizeof bits);
    return bits;
}

// What a compositor does: it looks the id of the pixel up in the manifest of the file.
TEST_F(RecorderPictures, CryptomattesNameWhatIsSeen) {
    if (rendererUnderTest() != "HiPR") GTEST_SKIP() << "an AOV of HiPR";
    const ImageFile image = picture({"--aovs", "color,CryptoObject,CryptoAsset", "--half"});
    std::map<std::string, nlohmann::json> manifests;
    for (const OIIO::ParamValue& value : image.spec().extra_attribs) {
        const std::string key = value.name().string();
        const size_t end = key.rfind("/name");
        if (key.rfind("cryptomatte/", 0) == 0 && end != std::string::npos)
            manifests[value.get_string()] = nlohmann::json::parse(
                std::string(image.spec().get_string_attribute(key.substr(0, end) + "/manifest")));
    }
    ASSERT_EQ(manifests.size(), 2u);
    const auto nameAt = [&](const std::string& matte, Spot spot) {
        char text[9];
        std::snprintf(text, sizeof text, "%08x", matteAt(image, matte + "00.R", spot));
        for (const auto& [name, id] : manifests[matte].items())
            if (id == text) return name;
        return std::string();
    };
    EXPECT_EQ(nameAt("CryptoObject", redSpot), "/World/Red");
    EXPECT_EQ(nameAt("CryptoObject", greenSpot), "/World/Green");
    EXPECT_EQ(nameAt("CryptoAsset", redSpot), "/World/Red");
    EXPECT_EQ(nameAt("CryptoObject", emptySpot), "");
    EXPECT_EQ(image.at("CryptoObject00.G", redSpot.x, redSpot.y), 1.f) << "all samples see it";
    EXPECT_EQ(image.at("CryptoObject02.A", redSpot.x, redSpot.y), 0.f);
    EXPECT_EQ(image.channelType("CryptoObject00.R"), "float") << "ids need all their bits";
    EXPECT_EQ(image.channelType("R"), "half");
    EXPECT_EQ(colourAt(image, redSpot), "red");
}

TEST_F(RecorderPictures, MetadataTellsHowThePictureWasMade) {
    const ImageFile image = picture({"--camera", "Front", "--frames", "2"});
    const OIIO::ImageSpec& spec = image.spec();
    EXPECT_THAT(spec.get_string_attribute("Software").c_str(), HasSubstr("hiprrecord"));
    EXPECT_EQ(spec.get_string_attribute("hipr:camera"), "/World/Front");
    EXPECT_THAT(spec.get_string_attribute("hipr:scene").c_str(), HasSubstr("squares.usda"));
    EXPECT_EQ(spec.get_float_attribute("hipr:frame"), 2.f);
    EXPECT_EQ(spec.get_int_attribute("hipr:samples"), 4);
    EXPECT_GE(spec.get_float_attribute("hipr:renderTime"), 0.f);
    EXPECT_THAT(spec.get_string_attribute("hipr:settings").c_str(), HasSubstr("convergedSamplesPerPixel=4"));
    if (rendererUnderTest() == "HiPR") {
        EXPECT_THAT(spec.get_string_attribute("hipr:settings").c_str(), HasSubstr("enableInteractive=0"));
    }

    float matrix[16] = {};
    ASSERT_TRUE(spec.getattribute("worldToCamera", OIIO::TypeMatrix, matrix));
    EXPECT_THAT(matrix, ElementsAre(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, -10, 1));
    ASSERT_TRUE(spec.getattribute("worldToNDC", OIIO::TypeMatrix, matrix));
    EXPECT_NEAR(matrix[0], 0.5f, 1e-5f) << "4 units wide";
}

TEST_F(RecorderPictures, EightBitFilesShowColour) {
    const Outcome outcome = record({"-o", file("a.png"), "-o", file("b.jpg"), "-o", file("c.jpeg")});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    for (const char* name : {"a.png", "b.jpg", "c.jpeg"}) {
        const ImageFile image(file(name));
        EXPECT_EQ(image.spec().nchannels, 3);
        EXPECT_GT(image.at("R", redSpot.x, redSpot.y), 0.95f) << name;
        EXPECT_LT(image.at("G", redSpot.x, redSpot.y), 0.05f) << name;
        EXPECT_LT(image.at("R", emptySpot.x, emptySpot.y), 0.05f) << name;
    }
}

TEST_F(RecorderPictures, AlphaKeepsTheBackgroundTransparent) {
    ASSERT_EQ(record({"-o", file("a.png"), "--alpha"}).code, 0);
    const ImageFile image(file("a.png"));
    ASSERT_EQ(image.spec().nchannels, 4);
    EXPECT_EQ(image.at("A", redSpot.x, redSpot.y), 1.f);
    EXPECT_EQ(image.at("A", emptySpot.x, emptySpot.y), 0.f);
}

TEST_F(RecorderPictures, ExposureChangesEightBitFilesOnly) {
    if (rendererUnderTest() != "HiPR") GTEST_SKIP() << "needs the exact radiance";
    ASSERT_EQ(record({"-o", file("a.png"), "-o", file("a.exr"), "--exposure", "-1"}).code, 0);
    // Half of 1 through the sRGB curve.
    EXPECT_NEAR(ImageFile(file("a.png")).at("R", redSpot.x, redSpot.y), 0.735f, 0.005f);
    EXPECT_NEAR(ImageFile(file("a.exr")).at("R", redSpot.x, redSpot.y), 1.f, 1e-5f);
}

TEST_F(RecorderPictures, EveryFrameHasItsFileAndItsScene) {
    const Outcome outcome = record({"-o", file("f.###.exr"), "--frames", "1:2"});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(files(), ElementsAre("f.001.exr", "f.002.exr")) << "and no temporary files";
    const Spot moved{greenSpot.x, greenSpot.y + 0.25};
    const ImageFile first(file("f.001.exr")), second(file("f.002.exr"));
    EXPECT_EQ(colourAt(first, greenSpot), "green");
    EXPECT_EQ(colourAt(first, moved), "none");
    EXPECT_EQ(colourAt(second, {greenSpot.x, greenSpot.y - 0.05}), "none");
    EXPECT_EQ(colourAt(second, moved), "green");
    EXPECT_EQ(colourAt(second, redSpot), "red");
}

TEST_F(RecorderPictures, LaterFrameAloneEqualsTheSameFrameOfASequence) {
    ASSERT_EQ(record({"-o", file("s.#.exr"), "--frames", "1:3"}).code, 0);
    ASSERT_EQ(record({"-o", file("alone.exr"), "--frames", "3"}).code, 0);
    for (const char* channel : {"R", "G", "B", "A"})
        EXPECT_EQ(ImageFile(file("s.3.exr")).values(channel), ImageFile(file("alone.exr")).values(channel));
}

TEST_F(RecorderPictures, UsdzGivesTheSamePicture) {
    auto package = PXR_NS::UsdZipFileWriter::CreateNew(file("squares.usdz"));
    package.AddFile(scene(), "squares.usda");
    ASSERT_TRUE(package.Save());
    ASSERT_EQ(record({"-o", file("plain.exr")}).code, 0);
    const Outcome outcome = recordStage(file("squares.usdz"), {"-o", file("package.exr")});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    for (const char* channel : {"R", "G", "B", "A"})
        EXPECT_EQ(ImageFile(file("plain.exr")).values(channel),
                  ImageFile(file("package.exr")).values(channel));
}

TEST_F(RecorderPictures, AutomaticCameraShowsEverythingAndTouchesNoBorder) {
    const ImageFile image = picture({"--camera", "auto"});
    EXPECT_EQ(image.spec().get_string_attribute("hipr:camera"), "auto");
    const std::vector<float> r = image.values("R"), g = image.values("G"), b = image.values("B"),
                             a = image.values("A");
    EXPECT_GT(*std::max_element(r.begin(), r.end()), 0.1f);
    EXPECT_GT(*std::max_element(g.begin(), g.end()), 0.1f);
    EXPECT_GT(*std::max_element(b.begin(), b.end()), 0.1f);
    for (size_t i = 0; i < 64; ++i) {
        EXPECT_EQ(a[i], 0.f) << "top";
        EXPECT_EQ(a[63 * 64 + i], 0.f) << "bottom";
        EXPECT_EQ(a[i * 64], 0.f) << "left";
        EXPECT_EQ(a[i * 64 + 63], 0.f) << "right";
    }
}

TEST_F(RecorderPictures, AuthoredCameraByNameOrPathDecidesTheAspectRatio) {
    const Outcome outcome = run(command(
        {scene(), "-o", file("side.exr"), "--camera", "/World/Side", "--size", "64", "--samples", "1"}));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const ImageFile image(file("side.exr"));
    EXPECT_EQ(image.spec().width, 64);
    EXPECT_EQ(image.spec().height, 32) << "the aperture is 40 x 20";
    EXPECT_EQ(colourAt(image, {0.5, 0.5}), "none") << "the squares are seen edge-on";
}

TEST_F(RecorderPictures, PurposesAndMaskDecideWhatIsSeen) {
    const auto alpha = [](const ImageFile& image, Spot spot) { return image.at("A", spot.x, spot.y); };
    const ImageFile plain = picture({});
    EXPECT_EQ(alpha(plain, guideSpot), 0.f);
    const ImageFile guides = picture({"--purposes", "guide"});
    EXPECT_EQ(alpha(guides, guideSpot), 1.f);
    EXPECT_EQ(alpha(guides, redSpot), 1.f);
    const ImageFile masked = picture({"--mask", "/World/Red", "--camera", "/World/Front"});
    EXPECT_EQ(alpha(masked, redSpot), 1.f);
    EXPECT_EQ(alpha(masked, greenSpot), 0.f);
}

TEST_F(RecorderPictures, ComplexityRoundsASubdivisionSurface) {
    write("cube.usda", R"(#usda 1.0
def Mesh "Cube"
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    float3[] extent = [(-1, -1, -1), (1, 1, 1)]
    point3f[] points = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1)]
}
)");
    const auto coverage = [&](const char* complexity) {
        const Outcome outcome =
            recordStage(file("cube.usda"), {"-o", file("cube.exr"), "--complexity", complexity});
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        double sum = 0;
        for (const float a : ImageFile(file("cube.exr")).values("A"))
            sum += double(a);
        return sum / (64.0 * 64.0);
    };
    const double cube = coverage("low"), rounded = coverage("high");
    EXPECT_GT(cube, 0.2);
    EXPECT_LT(rounded, 0.7 * cube) << "the limit surface of a cube is far inside it";
    EXPECT_GT(rounded, 0.2 * cube);
}

TEST_F(RecorderPictures, TimeLimitEndsAFrameEarly) {
    const auto start = std::chrono::steady_clock::now();
    const Outcome outcome =
        run(command({scene(), "-o", file("a.exr"), "--size", "64x64", "--time", "1", "--stats", "-", "-q"}));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(120));
    const nlohmann::json stats = nlohmann::json::parse(outcome.text);
    EXPECT_FALSE(stats["frames"][0]["converged"]);
    EXPECT_GE(stats["frames"][0]["seconds"], 1.0);
    EXPECT_GE(stats["frames"][0]["samples"], 1);
    if (rendererUnderTest() == "HiPR") {
        EXPECT_THAT(std::string(stats["settings"]), HasSubstr("enableInteractive=1")) << "ends in time";
    }
    EXPECT_EQ(colourAt(ImageFile(file("a.exr")), redSpot), "red");
}

TEST_F(RecorderPictures, StatisticsAndMemoryAreReported) {
    const Outcome outcome = record({"-o", file("a.exr"), "--stats", file("stats.json"), "--memory"});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("wrote " + file("a.exr")));
    if (rendererUnderTest() == "HiPR") {
        EXPECT_THAT(outcome.text, HasSubstr("iB")) << "a table of memory";
    }
    std::ifstream stream(file("stats.json"));
    const nlohmann::json stats = nlohmann::json::parse(stream);
    EXPECT_EQ(stats["width"], 64);
    EXPECT_EQ(stats["camera"], "/World/Front") << "the first camera of the stage";
    EXPECT_EQ(stats["frames"][0]["samples"], 4);
    EXPECT_TRUE(stats["frames"][0]["converged"]);
    EXPECT_EQ(stats["frames"][0]["files"][0], file("a.exr"));
}

TEST_F(RecorderPictures, ListsNeedNoOutput) {
    const Outcome cameras = run(command({scene(), "--list-cameras"}));
    EXPECT_EQ(cameras.code, 0);
    EXPECT_EQ(cameras.text, "/World/Front\n/World/Side\n");
    const Outcome settings = run(command({"--list-settings"}));
    EXPECT_EQ(settings.code, 0);
    EXPECT_THAT(settings.text, HasSubstr("convergedSamplesPerPixel"));
    const Outcome aovs = run(command({"--list-aovs"}));
    EXPECT_EQ(aovs.code, 0);
    EXPECT_THAT(aovs.text, HasSubstr("color\n"));
    EXPECT_THAT(aovs.text, HasSubstr("primId\n"));
}

} // namespace
} // namespace hipr::test
