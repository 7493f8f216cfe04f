// Motion blur from a stage to the picture: by velocities, and of skinned points.
#include <cmath>
#include <gmock/gmock.h>

#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

const std::string camera = R"(def Camera "Camera" {
    token projection = "orthographic"
    float horizontalAperture = 60
    float verticalAperture = 60
    float2 clippingRange = (1, 50)
    double shutter:open = 0
    double shutter:close = SHUTTER
    double3 xformOp:translate = (0, 0, 20)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
)";

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + with.size()))
        text.replace(at, what.size(), with);
    return text;
}

double meanDifference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += std::abs(double(a[i]) - double(b[i]));
    return sum / double(a.size());
}

class RecorderMotion : public RecorderTest {
protected:
    /// The coverage of pixels at frame 0, or the mean of it over several frames.
    std::vector<float> alpha(const std::string& stage, const std::string& frames = "0", int samples = 64) {
        write("stage.usda", stage);
        const Outcome outcome =
            run(command({file("stage.usda"), "-o", file("a.####.#####.exr"), "--size", "48x48", "--samples",
                         std::to_string(samples), "--frames", frames, "--camera", "/Camera"}));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        EXPECT_THAT(outcome.text, testing::Not(testing::HasSubstr("warning")));
        std::vector<float> mean;
        size_t pictures = 0;
        for (const std::string& name : files()) {
            if (name.rfind("a.", 0) != 0) continue;
            const std::vector<float> values = ImageFile(file(name)).values("A");
            mean.resize(values.size());
            for (size_t i = 0; i < values.size(); ++i)
                mean[i] += values[i];
            ++pictures;
            std::filesystem::remove(file(name));
        }
        for (float& value : mean)
            value /= float(pictures);
        return mean;
    }
};

/// A mesh, a curve, balls and instances one above the other, which go a unit to the right in a frame.
std::string moversBy(const std::string& points, const std::string& curve, const std::string& balls,
                     const std::string& positions) {
    return "#usda 1.0\n(\n    timeCodesPerSecond = 48\n)\n" + replaced(camera, "SHUTTER", "1") +
           R"(def Mesh "Mesh" {
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
)" + points +
           R"(
}
def BasisCurves "Curve" {
    uniform token type = "linear"
    int[] curveVertexCounts = [2]
    float[] widths = [0.5] ( interpolation = "constant" )
)" + curve +
           R"(
}
def Points "Balls" {
    float[] widths = [0.6, 0.6]
)" + balls +
           R"(
}
def PointInstancer "Instances" {
    rel prototypes = </Instances/Ball>
    int[] protoIndices = [0, 0]
)" + positions +
           R"(
    def Sphere "Ball" {
        double radius = 0.3
    }
}
)";
}

TEST_F(RecorderMotion, ByVelocitiesIsThatBySamples) {
    const auto sampled = [](const std::string& type, const std::string& name, const std::string& from,
                            const std::string& to) {
        return "    " + type + "[] " + name + ".timeSamples = { 0: [" + from + "], 1: [" + to + "] }";
    };
    const auto moved = [](const std::string& type, const std::string& name, const std::string& from,
                          const std::string& velocities) {
        return "    " + type + "[] " + name + ".timeSamples = { 0: [" + from + "] }\n" +
               "    vector3f[] velocities.timeSamples = { 0: [" + velocities + "] }";
    };
    const std::string mesh = "(-2, 2, 0), (-1, 2, 0), (-1, 2.6, 0), (-2, 2.6, 0)",
                      meshTo = "(-1, 2, 0), (0, 2, 0), (0, 2.6, 0), (-1, 2.6, 0)",
                      curve = "(-2, 1, 0), (0, 1.2, 0)", curveTo = "(-1, 1, 0), (1, 1.2, 0)",
                      dots = "(-2, Y, 0), (0.2, Y, 0)", dotsTo = "(-1, Y, 0), (1.2, Y, 0)",
                      two = "(48, 0, 0), (48, 0, 0)", low = "-2", middle = "0";
    const std::vector<float> bySamples = alpha(
        moversBy(sampled("point3f", "points", mesh, meshTo), sampled("point3f", "points", curve, curveTo),
                 sampled("point3f", "points", replaced(dots, "Y", middle), replaced(dotsTo, "Y", middle)),
                 sampled("point3f", "positions", replaced(dots, "Y", low), replaced(dotsTo, "Y", low))));
    const std::vector<float> byVelocities = alpha(
        moversBy(moved("point3f", "points", mesh, two + ", " + two), moved("point3f", "points", curve, two),
                 moved("point3f", "points", replaced(dots, "Y", middle), two),
                 moved("point3f", "positions", replaced(dots, "Y", low), two)));
    const std::vector<float> still =
        alpha(moversBy(sampled("point3f", "points", mesh, mesh), sampled("point3f", "points", curve, curve),
                       sampled("point3f", "points", replaced(dots, "Y", middle), replaced(dots, "Y", middle)),
                       sampled("point3f", "positions", replaced(dots, "Y", low), replaced(dots, "Y", low))));
    EXPECT_LT(meanDifference(byVelocities, bySamples), 1e-4);
    EXPECT_GT(meanDifference(still, bySamples), 0.05);
}

/// Instances that spin about their middle: two half turns of a bar are a disk.
TEST_F(RecorderMotion, ByAngularVelocities) {
    const std::string stage =
        "#usda 1.0\n" + replaced(camera, "SHUTTER", "1") + R"(def PointInstancer "Instances" {
    rel prototypes = </Instances/Bar>
    int[] protoIndices = [0]
    point3f[] positions.timeSamples = { 0: [(0, 0, 0)] }
    quath[] orientations.timeSamples = { 0: [(1, 0, 0, 0)] }
    vector3f[] angularVelocities.timeSamples = { 0: [(0, 0, SPIN)] }
    def Mesh "Bar" {
        uniform token subdivisionScheme = "none"
        point3f[] points = [(-2, -0.5, 0), (2, -0.5, 0), (2, 0.5, 0), (-2, 0.5, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
    }
}
)";
    const std::vector<float> spun =
        alpha(replaced(stage, "SPIN", std::to_string(360 * 24))); // a turn in a frame
    for (const double radius : {0.9, 1.4, 1.9})
        for (const double angle : {0.1, 0.9, 1.7, 2.9, 4.2}) {
            const int x = int((radius * std::cos(angle) / 6 + 0.5) * 48),
                      y = int((radius * std::sin(angle) / 6 + 0.5) * 48);
            EXPECT_NEAR(spun[size_t(y * 48 + x)], 4.0 * std::asin(0.5 / radius) / (2.0 * M_PI), 0.1)
                << radius << " " << angle;
        }
}

/// The bar of the scene skinning.usda bends by a right angle, and a blend shape leans to the left, in a
/// frame.
TEST_F(RecorderMotion, OfSkinnedPointsIsTheMeanOfItsMoments) {
    const std::string stage =
        "#usda 1.0\n" + camera +
        R"(def "Skinned" ( references = @)" HIPR_SOURCE_DIR
        R"(/testenv/scenes/skinning.usda@ (offset = SKIN; scale = 0.1111111111111111)) {
    double3 xformOp:translate = (1, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def "Leaning" ( references = @)" HIPR_SOURCE_DIR
        R"(/testenv/scenes/blend_shapes.usda@ (offset = SKIN; scale = 0.1111111111111111)) {
    double3 xformOp:translate = (-1, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
)";
    const std::string moving = replaced(stage, "SKIN", "-0.1111111111111111");
    const std::vector<float> blurred = alpha(replaced(moving, "SHUTTER", "1"), "0", 256),
                             still = alpha(replaced(moving, "SHUTTER", "0")),
                             moments = alpha(replaced(moving, "SHUTTER", "0"), "0.03125:0.96875x0.0625", 16);
    EXPECT_GT(meanDifference(still, blurred), 0.02);
    EXPECT_LT(meanDifference(moments, blurred), 0.006);
}

} // namespace
} // namespace hipr::test
