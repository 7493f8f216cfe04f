/// hiprconvert, and captures given to hiprrecord.
#include <cmath>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "renderer/splats/splat_file.h"
#include "testenv/host/recorder.h"

namespace hipr::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class Convert : public RecorderTest {
protected:
    Convert() {
        SplatCloud cloud;
        for (int i = 0; i < 5; ++i) {
            const float x = float(i);
            cloud.positions.emplace_back(x, 0.1f * x, -x);
            cloud.orientations.push_back(glm::normalize(glm::quat(1.f, 0.1f * x, 0.2f, -0.3f * x)));
            cloud.scales.emplace_back(0.1f + 0.01f * x, 0.2f, 0.3f);
            cloud.opacities.push_back(0.1f + 0.2f * x);
            for (uint32_t k = 0; k < shCoefficients(2); ++k)
                cloud.coefficients.emplace_back(0.1f * x, 0.02f * float(k), -0.5f);
        }
        cloud.shDegree = 2;
        std::ofstream out(file("in.ply"), std::ios::binary);
        writePly(cloud, out);
    }

    Outcome convert(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), HIPR_CONVERT_PROGRAM);
        return run(arguments);
    }
    /// What the renderer holds of a stage, without settings and cameras.
    std::string sceneOf(const std::string& stage) const {
        const Outcome outcome = recordStage(stage, {"-o", file("out.exr"), "--dump-scene", file("dump.txt")});
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        std::ifstream dump(file("dump.txt"));
        std::string scene;
        for (std::string line; std::getline(dump, line);)
            if (line.rfind("splats", 0) == 0 || line.rfind("object", 0) == 0) scene += line + "\n";
        return scene;
    }
};

SplatCloud read(const std::string& path) {
    return readSplatFile(path, {});
}

TEST_F(Convert, GivesTheSameSceneAsTheCapture) {
    const std::string scene = sceneOf(file("in.ply"));
    EXPECT_THAT(scene, AllOf(HasSubstr("splats /Splats positions 5"), HasSubstr("coefficients 45")));
    for (const char* name : {"out.usda", "out.usdc", "out.usd"}) {
        const Outcome outcome = convert({file("in.ply"), file(name)});
        EXPECT_EQ(outcome.code, 0) << outcome.text;
        EXPECT_THAT(outcome.text, HasSubstr("(5 splats)"));
        EXPECT_EQ(sceneOf(file(name)), scene) << name;
    }
}

TEST_F(Convert, AndBackGivesTheSameSplats) {
    ASSERT_EQ(convert({file("in.ply"), file("out.usdc")}).code, 0);
    const Outcome outcome = convert({file("out.usdc"), file("back.ply")});
    ASSERT_EQ(outcome.code, 0) << outcome.text;
    const SplatCloud before = read(file("in.ply")), after = read(file("back.ply"));
    EXPECT_EQ(after.positions, before.positions);
    EXPECT_EQ(after.coefficients, before.coefficients);
    for (size_t i = 0; i < before.size(); ++i) {
        EXPECT_NEAR(after.opacities[i], before.opacities[i], 1e-6f);
        EXPECT_NEAR(after.scales[i].x, before.scales[i].x, 1e-6f);
        EXPECT_NEAR(std::abs(glm::dot(after.orientations[i], before.orientations[i])), 1.f, 1e-6f);
    }
}

TEST_F(Convert, TurnsUpright) {
    ASSERT_EQ(convert({"--up", "-y", file("in.ply"), file("out.usda")}).code, 0);
    std::stringstream text;
    text << std::ifstream(file("out.usda")).rdbuf();
    EXPECT_THAT(text.str(), HasSubstr("float xformOp:rotateX = 180"));
}

TEST_F(Convert, TakesTheChosenPrim) {
    write("two.usda",
          "#usda 1.0\ndef \"A\" (\n    references = @./in.ply@\n)\n{\n}\n"
          "def \"B\" (\n    references = @./in.ply@\n)\n{\n    float[] opacities = [1, 1, 1, 1, 1]\n}\n");
    // The stage needs our file format; hosts know it by PXR_PLUGINPATH_NAME.
    const std::string stage = file("two.usda");
    const Outcome unclear = convert({stage, file("out.ply")});
    EXPECT_EQ(unclear.code, 1);
    EXPECT_THAT(unclear.text, HasSubstr("2 prims with splats; choose one: --prim /A"));
    const Outcome chosen = convert({stage, file("out.ply"), "--prim", "/B"});
    ASSERT_EQ(chosen.code, 0) << chosen.text;
    EXPECT_EQ(read(file("out.ply")).opacities, std::vector<float>(5, 1.f));
    EXPECT_THAT(convert({stage, file("out.ply"), "--prim", "/C"}).text, HasSubstr("has no splats at /C"));
}

TEST_F(Convert, SaysWhatIsWrong) {
    write("broken.ply", "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nend_header\n1\n");
    const std::pair<std::vector<std::string>, const char*> cases[] = {
        {{file("none.ply"), file("a.usda")}, "none.ply cannot be opened: No such file"},
        {{file("broken.ply"), file("a.usda")}, "broken.ply lacks the property 'y'"},
        {{file("in.ply"), file("no/such/folder.ply")}, "cannot be written"},
        {{file("in.ply"), file("a.usda"), "--up", "left"}, "none of y, -y, z, -z"},
        {{file("in.ply"), file("a.ply"), "--up", "-y"}, "cannot say where up is"},
        {{scene(), file("a.ply")}, "has no splats"},
        {{scene(), file("a.usda")}, "is no capture"}};
    for (const auto& [arguments, why] : cases) {
        const Outcome outcome = convert(arguments);
        EXPECT_EQ(outcome.code, 1) << why;
        EXPECT_THAT(outcome.text, HasSubstr(why));
    }
    EXPECT_THAT(convert({"--help"}).text, AllOf(HasSubstr("examples:"), HasSubstr("--up")));
}

TEST_F(Convert, ABrokenCaptureIsNoStage) {
    write("broken.ply", "ply\n");
    const Outcome outcome = recordStage(file("broken.ply"), {"-o", file("out.exr")});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.text, HasSubstr("PLY header without an end"));
}

} // namespace
} // namespace hipr::test
