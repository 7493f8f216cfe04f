/// Volumes through Hydra: what reaches the renderer and the picture, and what is said of those that do not.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugin/hdHipr/commands.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/imaging/hd/field.h"
#include "pxr/usd/sdf/assetPath.h"
#include "testenv/common/vdb_kit.h"
#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using hipr::test::VdbGrid;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A box of 4 x 4 x 1 around the origin with this density.
std::string box(char const* name, double density, VdbGrid::Kind kind = VdbGrid::Kind::Float) {
    VdbGrid grid;
    grid.kind = kind;
    grid.lo = {-20, -20, -5};
    grid.hi = {19, 19, 4};
    grid.value = [=](glm::ivec3) { return density; };
    const std::string path = testing::TempDir() + name + ".vdb";
    hipr::test::writeVdb(path, {grid});
    return path;
}

/// Messages are said once in the life of a process, so every test has prims of its own name.
struct Volumes : testing::Test {
    Volumes() : host({"color"}, 64) { host.scene().addDome(SdfPath("/dome")); }

    TestScene::Prim& add(char const* name, std::string const& file) {
        const SdfPath path(name);
        TestScene::Prim& prim = host.scene().addVolume(path);
        setValue(prim, "hipr:volume:albedo", VtValue(GfVec3f(0.f)));
        host.scene().addField(path.AppendProperty(TfToken("density")), file, path);
        return prim;
    }
    static void setValue(TestScene::Prim& prim, char const* name, VtValue const& value) {
        prim.primvars[TfToken(name)] = {HdInterpolationConstant, value};
    }
    /// What is left of the sky: the mean of the picture.
    float shown() {
        EXPECT_TRUE(host.render());
        float sum = 0;
        for (int y = 0; y < TestHost::height; ++y) {
            for (int x = 0; x < TestHost::width; ++x) {
                sum +=
                    host.readColor((x + 0.5) / TestHost::width - 0.5, (y + 0.5) / TestHost::height - 0.5)[0];
            }
        }
        return sum / float(TestHost::width * TestHost::height);
    }

    TestHost host;
    TestWarnings warnings;
};

TEST_F(Volumes, absorbByTheirDensityAndItsScale) {
    TestScene::Prim& prim = add("/absorbing", box("absorbing", 0.5));
    EXPECT_NEAR(shown(), std::exp(-0.5f), 0.01f);
    setValue(prim, "hipr:volume:density", VtValue(3.f));
    host.scene().tracker().MarkRprimDirty(SdfPath("/absorbing"), HdChangeTracker::DirtyPrimvar);
    EXPECT_NEAR(shown(), std::exp(-1.5f), 0.01f);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Volumes, readTheirFilesAgainByCommand) {
    const std::string file = box("reread", 0.5);
    const auto written = std::filesystem::last_write_time(file);
    add("/reread", file);
    EXPECT_NEAR(shown(), std::exp(-0.5f), 0.01f);
    EXPECT_EQ(box("reread", 2), file);
    std::filesystem::last_write_time(file, written); // as if within the clock's resolution
    EXPECT_NEAR(shown(), std::exp(-0.5f), 0.01f);
    EXPECT_TRUE(hdhipr::invokeCommand(host.param(), TfToken("reloadTextures"), {}));
    EXPECT_NEAR(shown(), std::exp(-2.f), 0.01f);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Volumes, showTheFileThatTheirFieldNames) {
    add("/animated", box("frame1", 0.5));
    EXPECT_NEAR(shown(), std::exp(-0.5f), 0.01f);
    host.scene().prim(SdfPath("/animated.density")).params[TfToken("filePath")] =
        VtValue(SdfAssetPath(box("frame2", 2)));
    host.scene().tracker().MarkBprimDirty(SdfPath("/animated.density"), HdField::DirtyParams);
    EXPECT_NEAR(shown(), std::exp(-2.f), 0.01f);
    host.scene().remove(SdfPath("/animated.density"));
    EXPECT_NEAR(shown(), 1.f, 1e-4f);
}

TEST_F(Volumes, takeTheMediumOfTheirMaterial) {
    HdMaterialNode vdf{SdfPath("/medium/vdf"), TfToken("ND_anisotropic_vdf"), {}};
    vdf.parameters[TfToken("absorption")] = VtValue(GfVec3f(4.f));
    HdMaterialNode edf{SdfPath("/medium/edf"), TfToken("ND_uniform_edf"), {}};
    edf.parameters[TfToken("color")] =
        VtValue(GfVec3f(8.f)); // what such a medium glows with where it is thick: 2
    HdMaterialNode volume{SdfPath("/medium/volume"), TfToken("ND_volume"), {}};
    HdMaterialNetworkMap networks;
    networks.map[HdMaterialTerminalTokens->volume] = {
        {{vdf.path, TfToken("out"), volume.path, TfToken("vdf")},
         {edf.path, TfToken("out"), volume.path, TfToken("edf")}},
        {vdf, edf, volume},
        {}};
    networks.terminals = {volume.path};
    TestScene::Prim& material = host.scene().addMaterial(SdfPath("/medium"), GfVec3f(0.5f));
    material.resource = VtValue(networks);
    add("/made_of_a_medium", box("medium", 0.5)).material = SdfPath("/medium");
    EXPECT_NEAR(shown(), std::exp(-2.f) + 2.f * (1.f - std::exp(-2.f)), 0.02f);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Volumes, sayWhatIsWrongWithTheirFields) {
    add("/named", box("named", 1))
        .fields.emplace_back(TfToken("vel"), TfToken("openvdbAsset"), SdfPath("/named.vel"));
    add("/other", "").fields[0].fieldPrimType = TfToken("field3dAsset");
    add("/missing", "/nowhere/at/all.vdb");
    add("/level_set", box("level_set", 1, VdbGrid::Kind::LevelSet));
    host.scene().addVolume(SdfPath("/bare"));
    host.scene()
        .addVolume(SdfPath("/lost"))
        .fields.emplace_back(TfToken("density"), TfToken("openvdbAsset"), SdfPath("/lost.density"));
    TestScene::Prim& odd = add("/odd", box("odd", 1));
    setValue(odd, "hipr:volume:density", VtValue(std::nanf("")));
    setValue(odd, "hipr:volume:albdeo", VtValue(1.f));
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(),
                testing::UnorderedElementsAre(
                    AllOf(HasSubstr("</named>"), HasSubstr("'vel' is not supported")),
                    AllOf(HasSubstr("</other>"), HasSubstr("'field3dAsset'")),
                    AllOf(HasSubstr("</other>"), HasSubstr("nothing is seen")),
                    AllOf(HasSubstr("</other.density>"), HasSubstr("names no file")),
                    AllOf(HasSubstr("</missing.density>"), HasSubstr("/nowhere/at/all.vdb")),
                    AllOf(HasSubstr("</level_set.density>"), HasSubstr("level set")),
                    AllOf(HasSubstr("</lost>"), HasSubstr("does not hand over its field 'density'")),
                    AllOf(HasSubstr("</odd>"), HasSubstr("'hipr:volume:density' is no finite number")),
                    AllOf(HasSubstr("</odd>"), HasSubstr("there is no primvar 'hipr:volume:albdeo'")),
                    AllOf(HasSubstr("</bare>"), HasSubstr("nothing is seen"))));
}

/// The right edge of a box goes from x = -1 to 1 while the shutter is open.
TEST_F(Volumes, moveWhileAShutterIsOpen) {
    const SdfPath eye("/volume_eye");
    TestScene::Prim& camera = host.scene().addCamera(eye, 3.0);
    camera.transform.SetTranslate(GfVec3d(0, 0, 10));
    camera.params[TfToken("shutterOpen")] = VtValue(0.0);
    camera.params[TfToken("shutterClose")] = VtValue(1.0);
    host.setCamera(eye);
    TestScene::Prim& prim = add("/moving_fog", box("moving_fog", 1));
    prim.transform.SetTranslate(GfVec3d(-2.95, 0, 0));
    prim.shutterMotion.SetTranslate(GfVec3d(2, 0, 0));
    EXPECT_TRUE(host.render());
    for (double x = -1.2; x < 1.3; x += 0.3) {
        const double share = std::clamp(0.5 - 0.5 * x, 0.0, 1.0);
        float sum = 0;
        for (int row = -8; row < 8; ++row) {
            sum += host.readColor(x / 3, (row + 0.5) / TestHost::height)[0];
        }
        EXPECT_NEAR(sum / 16, 1 - share * (1 - std::exp(-1.0)), 0.06) << x;
    }
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

} // namespace
