// Scenes made by others: the picture is not blank, shows as much as it should, and memory stays within what
// instancing allows.
#include <cmath>
#include <fstream>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <set>

#include "testenv/host/recorder.h"
#include "testenv/real/assets.h"

namespace hipr::test {
namespace {

constexpr uint32_t NoId = 0xffffffffu;
constexpr double MiB = 1024.0 * 1024.0;

/// What a picture shows, in numbers.
struct Summary {
    double coverage = 0.0;  ///< share of pixels with a prim
    double luminance = 0.0; ///< mean of those pixels, each at most 1
    double contrast = 0.0;  ///< standard deviation of the same
    std::set<uint32_t> prims;
    std::set<std::pair<uint32_t, uint32_t>> instances; ///< prim and instance
};

class RealScenes : public RecorderTest {
protected:
    std::string asset(const std::string& path) const { return assetsFolder() + "/usd-wg/" + path; }

    /// Records color and ids; keeps the statistics of the last frame in `stats`.
    Summary recordScene(const std::string& stage, std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {stage, "-o", file("a.exr"), "--aovs", "color,primId,instanceId",
                                             "--stats", file("a.json")});
        const Outcome outcome = run(command(std::move(arguments)));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        said = outcome.text;
        std::ifstream(file("a.json")) >> stats;
        stats = stats["frames"].back()["renderStats"];
        return summarise(ImageFile(file("a.exr")));
    }

    static Summary summarise(const ImageFile& image) {
        Summary summary;
        const std::vector<float> r = image.values("R"), g = image.values("G"), b = image.values("B");
        const std::vector<uint32_t> prims = image.ids("primId.I"), instances = image.ids("instanceId.I");
        double sum = 0.0, squares = 0.0, covered = 0.0;
        size_t broken = 0;
        for (size_t i = 0; i < prims.size(); ++i) {
            broken += !std::isfinite(r[i] + g[i] + b[i]);
            if (prims[i] == NoId) continue;
            const double luminance = std::min(1.0, 0.2126 * r[i] + 0.7152 * g[i] + 0.0722 * b[i]);
            sum += luminance;
            squares += luminance * luminance;
            covered += 1.0;
            summary.prims.insert(prims[i]);
            summary.instances.insert({prims[i], instances[i]});
        }
        EXPECT_EQ(broken, 0u) << "pixels that are NaN or infinite";
        summary.coverage = covered / double(prims.size());
        if (covered == 0.0) return summary;
        summary.luminance = sum / covered;
        summary.contrast =
            std::sqrt(std::max(0.0, squares / covered - summary.luminance * summary.luminance));
        return summary;
    }

    double memory(const std::string& kind) const { return stats.value("hipr:memory:" + kind, 0.0) / MiB; }

    nlohmann::json stats;
    std::string said; ///< what the recorder wrote
};

TEST_F(RealScenes, TeapotDrawModes) {
    const Summary shown =
        recordScene(asset("full_assets/Teapot/DrawModes.usd"), {"--size", "480x270", "--samples", "8"});
    EXPECT_GT(shown.coverage, 0.08);
    EXPECT_LT(shown.coverage, 0.6);
    EXPECT_GT(shown.luminance, 0.05);
    EXPECT_LT(shown.luminance, 0.7);
    EXPECT_GT(shown.contrast, 0.05);
    EXPECT_GE(shown.prims.size(), 15u) << "teapots, crosses and boxes of seven colours and more";
}

TEST_F(RealScenes, MiniCar) {
    const Summary shown =
        recordScene(asset("full_assets/Vehicles/USD_Mini_Car_Kit/assets/vehicles/vehicleVariants.usda"),
                    {"--size", "480x270", "--samples", "8"});
    EXPECT_GT(shown.coverage, 0.1);
    EXPECT_LT(shown.coverage, 0.6);
    EXPECT_GT(shown.luminance, 0.01);
    EXPECT_GT(shown.contrast, 0.01);
    EXPECT_GE(shown.prims.size(), 5u);
}

/// Materials of MaterialX documents: images, normal maps, metal, glass, subsurface.
TEST_F(RealScenes, ChessSet) {
    const Summary shown =
        recordScene(asset("full_assets/OpenChessSet/chess_set.usda"), {"--size", "160x90", "--samples", "2"});
    EXPECT_GT(shown.coverage, 0.2);
    EXPECT_LT(shown.coverage, 0.5);
    EXPECT_GT(shown.luminance, 0.01);
    EXPECT_GT(shown.contrast, 0.02);
    EXPECT_GE(shown.prims.size(), 20u) << "board and pieces";
    EXPECT_THAT(said, testing::Not(testing::HasSubstr("not supported")));
    EXPECT_THAT(said, testing::Not(testing::HasSubstr(".mtlx")));
    EXPECT_THAT(said, testing::Not(testing::HasSubstr("texture")));
}

/// 524 native instances and 529 point-instanced prototypes of a teapot with 2,472 triangles. The published
/// root layer has a sublayer that is not there, so the test makes its own over the others.
class Teapots : public RealScenes {
protected:
    void SetUp() override {
        std::string layers;
        for (const char* name : {"layoutOverrides", "camera", "layout"})
            layers += "        @" + asset("intent-vfx/scenes/teapotScene_") + name + ".usd@,\n";
        write("teapots.usda", "#usda 1.0\n(\n    metersPerUnit = 1\n    subLayers = [\n" + layers +
                                  "    ]\n    upAxis = \"Y\"\n)\n" + lights);
    }

    /// `Above` looks straight down on 38 x 38 units: all of the layout.
    static constexpr const char* lights = R"(
def DomeLight "Sky"
{
    float intensity = 0.6
    float inputs:intensity = 0.6
}

def DistantLight "Sun"
{
    float intensity = 8000
    float inputs:intensity = 8000
    float angle = 1
    float inputs:angle = 1
    float3 xformOp:rotateXYZ = (-50, 30, 0)
    uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
}

def Camera "Above"
{
    token projection = "orthographic"
    float horizontalAperture = 380
    float verticalAperture = 380
    float2 clippingRange = (1, 50)
    double3 xformOp:translate = (0, 20, 0)
    float xformOp:rotateX = -90
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
)";
};

TEST_F(Teapots, AllInstancesAreSeenFromAbove) {
    const Summary shown =
        recordScene(file("teapots.usda"), {"--camera", "Above", "--size", "1520x1520", "--samples", "1"});
    // A few teapots stand inside others.
    EXPECT_GE(shown.instances.size(), 1000u);
    EXPECT_LE(shown.instances.size(), 1053u);
    EXPECT_GT(shown.coverage, 0.02);
}

TEST_F(Teapots, CameraViewIsLitAndMemoryIsThatOfThePrototypes) {
    const Summary shown =
        recordScene(file("teapots.usda"), {"--camera", "mono", "--size", "480x270", "--samples", "8"});
    EXPECT_GT(shown.coverage, 0.05);
    EXPECT_LT(shown.coverage, 0.5);
    EXPECT_GT(shown.luminance, 0.1);
    EXPECT_GT(shown.contrast, 0.05);
    // 31 prototypes of 2,472 triangles; flattened, the 2.6 million triangles would take hundreds of
    // megabytes.
    EXPECT_LT(memory("Geometry") + memory("Primvars") + memory("Host: acceleration structures") +
                  memory("Host: meshes"),
              64.0);
    EXPECT_GT(memory("Geometry"), 0.0);
    EXPECT_GT(memory("Instance tables"), 0.0);
    EXPECT_LT(memory("Instance tables"), 1.0);
}

} // namespace
} // namespace hipr::test
