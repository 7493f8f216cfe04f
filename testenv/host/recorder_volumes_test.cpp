/// Volumes from USD to the picture, by hiprrecord.
#include <cmath>

#include <gmock/gmock.h>

#include "pxr/usd/usd/zipFile.h"
#include "testenv/common/vdb_kit.h"
#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

/// The camera sees 4 x 2 units; behind is a sky of radiance 1. Boxes of 1 x 1 x 1 of density 1: one that only
/// absorbs, one of a material, one by an instancer in twice its size, and nothing at the right.
const char* const Stage = R"(#usda 1.0
def Xform "World" {
    def Camera "Camera" {
        token projection = "orthographic"
        float horizontalAperture = 40
        float verticalAperture = 20
        double3 xformOp:translate = (0, 0, 20)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def DomeLight "Sky" {
    }
    def Material "Medium" {
        token outputs:volume.connect = </World/Medium/Volume.outputs:out>
        def Shader "Volume" {
            uniform token info:id = "ND_volume"
            token inputs:vdf.connect = </World/Medium/Vdf.outputs:out>
            token outputs:out
        }
        def Shader "Vdf" {
            uniform token info:id = "ND_absorption_vdf"
            vector3f inputs:absorption = (0.5, 1, 2)
            token outputs:out
        }
    }
    def Volume "Plain" {
        rel field:density = </World/Plain/density>
        color3f primvars:hipr:volume:albedo = (0, 0, 0)
        double3 xformOp:translate = (-1.5, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def OpenVDBAsset "density" {
            asset filePath = @./box.vdb@
            token fieldName = "density"
        }
    }
    def Volume "Bound" {
        rel field:density = </World/Plain/density>
        rel material:binding = </World/Medium>
        double3 xformOp:translate = (-0.3, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def PointInstancer "Copies" {
        rel prototypes = </World/Copies/Box>
        int[] protoIndices = [0]
        point3f[] positions = [(1, 0, 0)]
        float3[] scales = [(1, 1, 2)]
        def Volume "Box" {
            rel field:density = </World/Copies/Box/density>
            color3f primvars:hipr:volume:albedo = (0, 0, 0)
            def OpenVDBAsset "density" {
                asset filePath = @./box.vdb@
                token fieldName = "density"
            }
        }
    }
}
)";

class RecorderVolumes : public RecorderTest {
protected:
    RecorderVolumes() {
        VdbGrid box;
        box.lo = glm::ivec3(-10);
        box.hi = glm::ivec3(10);
        box.spacing = glm::dvec3(0.05);
        writeVdb(file("box.vdb"), {box});
        write("stage.usda", Stage);
    }
    ImageFile picture(const std::string& stage) const {
        const Outcome outcome =
            run(command({stage, "-o", file("a.exr"), "--size", "80x40", "--samples", "64"}));
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        EXPECT_THAT(outcome.text, testing::Not(testing::HasSubstr("warning"))) << outcome.text;
        return ImageFile(file("a.exr"));
    }
};

/// The mean of a channel around a place of the camera's plane.
float shownAt(const ImageFile& image, const char* channel, double x) {
    float sum = 0.f;
    for (int i = 0; i < 64; ++i)
        sum += image.at(channel, 0.5 + (x + 0.04 * (i % 8 - 3.5)) / 4, 0.5 + 0.04 * (i / 8 - 3.5) / 2);
    return sum / 64.f;
}

TEST_F(RecorderVolumes, AbsorbAsTheirPrimvarsMaterialsAndInstancersSay) {
    const ImageFile image = picture(file("stage.usda"));
    // Density falls to 0 within one step outside of the box: its optical thickness is 1.05.
    const float one = 1.05f;
    EXPECT_NEAR(shownAt(image, "R", -1.5), std::exp(-one), 0.03f);
    EXPECT_NEAR(shownAt(image, "R", -0.3), std::exp(-0.5f * one), 0.03f);
    EXPECT_NEAR(shownAt(image, "G", -0.3), std::exp(-one), 0.03f);
    EXPECT_NEAR(shownAt(image, "B", -0.3), std::exp(-2 * one), 0.03f);
    EXPECT_NEAR(shownAt(image, "R", 1), std::exp(-2 * one), 0.03f);
    EXPECT_NEAR(shownAt(image, "R", 1.8), 1.f, 1e-4f);
}

TEST_F(RecorderVolumes, FollowTheirFilesOverTime) {
    VdbGrid thick;
    thick.lo = glm::ivec3(-10);
    thick.hi = glm::ivec3(10);
    thick.spacing = glm::dvec3(0.05);
    thick.value = [](glm::ivec3) { return 3.0; };
    writeVdb(file("thick.vdb"), {thick});
    std::string stage = Stage;
    const std::string still = "asset filePath = @./box.vdb@";
    stage.replace(stage.find(still), still.size(),
                  "asset filePath.timeSamples = {\n1: @./box.vdb@,\n2: @./thick.vdb@,\n}");
    write("animated.usda", stage);
    const Outcome outcome = run(command({file("animated.usda"), "-o", file("f.#.exr"), "--frames", "1:2",
                                         "--size", "80x40", "--samples", "64"}));
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_NEAR(shownAt(ImageFile(file("f.1.exr")), "R", -1.5), std::exp(-1.05f), 0.03f);
    EXPECT_NEAR(shownAt(ImageFile(file("f.2.exr")), "R", -1.5), std::exp(-3.15f), 0.03f);
}

TEST_F(RecorderVolumes, PackagesGiveTheSamePicture) {
    auto package = PXR_NS::UsdZipFileWriter::CreateNew(file("stage.usdz"));
    package.AddFile(file("stage.usda"), "stage.usda");
    package.AddFile(file("box.vdb"), "box.vdb");
    ASSERT_TRUE(package.Save());
    const ImageFile plain = picture(file("stage.usda")), packed = picture(file("stage.usdz"));
    for (const char* channel : {"R", "G", "B", "A"})
        EXPECT_EQ(plain.values(channel), packed.values(channel));
}

} // namespace
} // namespace hipr::test
