/// What hiprrecord says and returns when it cannot do what it is asked.
#include <gmock/gmock.h>

#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

class RecorderErrors : public RecorderTest {};

TEST_F(RecorderErrors, HelpTeachesAndSucceeds) {
    const Outcome help = run(command({"--help"}));
    EXPECT_EQ(help.code, 0);
    EXPECT_THAT(help.text, HasSubstr("Examples:"));
    EXPECT_THAT(help.text, HasSubstr("Exit codes:"));
}

TEST_F(RecorderErrors, UsageIsOne) {
    const Outcome outcome = run(command({"--sampels", "4"}));
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.text, HasSubstr("--sampels"));
}

TEST_F(RecorderErrors, UnknownSettingIsNamedWithTheNearestAndAllOthers) {
    const Outcome outcome = record({"-o", file("a.exr"), "--set", "convergedSamplesPerPixl=3"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.text, HasSubstr("Did you mean 'convergedSamplesPerPixel'?"));
    EXPECT_THAT(outcome.text, HasSubstr("Known settings:"));
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(RecorderErrors, SettingOfTheWrongTypeIsRefused) {
    const Outcome outcome = record({"-o", file("a.exr"), "--set", "convergedSamplesPerPixel=many"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.text, HasSubstr("'many' is no int"));
}

TEST_F(RecorderErrors, SettingOutsideItsRangeIsRefused) {
    if (rendererUnderTest() != "HiPR") GTEST_SKIP() << "ranges are HiPR's";
    const Outcome outcome = record({"-o", file("a.exr"), "--set", "hipr:maxDepth=-1"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.text, HasSubstr("hipr:maxDepth"));
}

TEST_F(RecorderErrors, UnknownAovIsRefusedAndOthersListed) {
    const Outcome outcome = record({"-o", file("a.exr"), "--aovs", "color,depht"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.text, HasSubstr("'depht'"));
    EXPECT_THAT(outcome.text, HasSubstr(" cameraDepth"));
}

TEST_F(RecorderErrors, UnknownViewIsRefused) {
    const Outcome outcome = record({"-o", file("a.png"), "--view", "NoSuchView"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.text, HasSubstr("NoSuchView"));
}

TEST_F(RecorderErrors, StageThatIsNotThereIsTwo) {
    const Outcome outcome = recordStage(file("missing.usda"), {"-o", file("a.exr")});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.text, HasSubstr("missing.usda"));
}

TEST_F(RecorderErrors, StageThatIsDamagedIsTwo) {
    write("broken.usda", "#usda 1.0\ndef Xform \"World\" {{{ ");
    write("broken.usdc", "PXR-USDC and then nothing of use");
    write("broken.usdz", "PK no zip");
    write("picture.txt", "no stage at all");
    for (const char* name : {"broken.usda", "broken.usdc", "broken.usdz", "picture.txt"}) {
        const Outcome outcome = recordStage(file(name), {"-o", file("a.exr")});
        EXPECT_EQ(outcome.code, 2) << name << ": " << outcome.text;
        EXPECT_THAT(outcome.text, HasSubstr(name));
    }
}

TEST_F(RecorderErrors, BrokenReferenceIsSaidOnceAndTheRestIsRecorded) {
    write("scene.usda",
          "#usda 1.0\n(subLayers = [@" + scene() + "@])\ndef \"Broken\" (references = @gone.usda@) {}\n");
    const Outcome outcome = recordStage(file("scene.usda"), {"-o", file("a.exr"), "--camera", "auto"});
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    const size_t first = outcome.text.find("gone.usda");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(outcome.text.find("warning: Could not open asset", outcome.text.find('\n', first)),
              std::string::npos);
}

TEST_F(RecorderErrors, NoSuchCameraIsThreeAndCamerasAreListed) {
    const Outcome outcome = record({"-o", file("a.exr"), "--camera", "Frnot"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.text, HasSubstr("'Frnot'"));
    EXPECT_THAT(outcome.text, HasSubstr("/World/Side"));
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(RecorderErrors, OutputThatCannotBeWrittenIsFourBeforeAnythingIsRendered) {
    // So many samples that rendering first would run into the time limit of the test.
    const Outcome outcome =
        run(command({scene(), "-o", file("no/such/folder/a.exr"), "--samples", "1000000"}));
    EXPECT_EQ(outcome.code, 4);
    EXPECT_THAT(outcome.text, HasSubstr("no/such/folder/a.exr"));
}

TEST_F(RecorderErrors, OutputThatIsAFolderIsFour) {
    std::filesystem::create_directory(file("a.exr"));
    EXPECT_EQ(record({"-o", file("a.exr")}).code, 4);
}

TEST_F(RecorderErrors, UnknownRendererIsFiveAndRenderersAreListed) {
    const Outcome outcome = run({HIPR_RECORD_PROGRAM, scene(), "-o", file("a.exr"), "--renderer", "NoSuch"});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_THAT(outcome.text, HasSubstr("'NoSuch'"));
}

TEST_F(RecorderErrors, UnknownDeviceIsFive) {
    if (rendererUnderTest() != "HiPR") GTEST_SKIP() << "only HiPR has devices";
    const Outcome outcome = record({"-o", file("a.exr"), "--device", "NoSuchDevice"});
    EXPECT_EQ(outcome.code, 5);
    EXPECT_THAT(outcome.text, HasSubstr("NoSuchDevice"));
    EXPECT_THAT(files(), IsEmpty());
}

TEST_F(RecorderErrors, PictureLargerThanTheMachineIsFive) {
    const Outcome outcome =
        run(command({scene(), "-o", file("a.exr"), "--size", "65536x65536", "--aovs", "color,normal"}));
    EXPECT_EQ(outcome.code, 5);
    EXPECT_THAT(outcome.text, HasSubstr("GiB"));
}

TEST_F(RecorderErrors, InterruptedWritesWhatIsThereAndReturns130) {
    Process process(command({scene(), "-o", file("a.exr"), "--size", "64x64", "--samples", "1000000"}));
    ASSERT_TRUE(process.waitFor(" samples"));
    process.interrupt();
    EXPECT_EQ(process.finish().code, 130);
    EXPECT_THAT(files(), ElementsAre("a.exr"));
    EXPECT_EQ(ImageFile(file("a.exr")).spec().width, 64);
}

/// Native instances within each other, and a prototype of a point instancer. Later OpenUSD hands all over.
TEST_F(RecorderErrors, LightsInsideInstancesAreNamed) {
    write("lamps.usda", R"(#usda 1.0
class Xform "Lamp" {
    def SphereLight "Bulb" {
    }
}
class Xform "Pair" {
    def Xform "Left" (
        instanceable = true
        inherits = </Lamp>
    ) {
    }
}
def Xform "First" (
    instanceable = true
    inherits = </Pair>
) {
}
def Xform "Second" (
    instanceable = true
    inherits = </Pair>
) {
}
def PointInstancer "Row" {
    rel prototypes = </Row/Disk>
    def DiskLight "Disk" {
    }
}
def RectLight "Alone" {
}
)");
    const Outcome outcome = recordStage(file("lamps.usda"), {"-o", file("a.exr")});
    EXPECT_EQ(outcome.code, 0);
#ifdef HIPR_TEST_HYDRA_INSTANCES_LIGHTS
    EXPECT_THAT(outcome.text, Not(HasSubstr("inside instances")));
#else
    EXPECT_THAT(outcome.text, HasSubstr("</First/Left/Bulb> and 1 more inside instances"));
#endif
}

} // namespace
} // namespace hipr::test
