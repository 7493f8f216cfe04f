/// Captures as layers of USD.
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugin/usdSplat/splatLayer.h"
#include "pxr/base/gf/quatf.h"
#include "pxr/base/tf/error.h"
#include "pxr/base/tf/errorMark.h"
#include "pxr/usd/sdf/fileFormat.h"
#include "pxr/usd/usd/attribute.h"
#include "pxr/usd/usd/prim.h"
#include "pxr/usd/usdGeom/bboxCache.h"
#include "pxr/usd/usdGeom/xformable.h"
#include "renderer/splats/splat_file.h"
#include "testenv/unit/delegate/test_warnings.h"
#include "testenv/unit/usdSplat/splat_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

hipr::SplatCloud twoSplats() {
    hipr::SplatCloud cloud;
    cloud.positions = {{1, 2, 3}, {-1, 0, 0}};
    cloud.orientations = {glm::quat(std::sqrt(0.5f), 0.f, 0.f, std::sqrt(0.5f)),
                          glm::quat(1.f, 0.f, 0.f, 0.f)};
    cloud.scales = {{0.5f, 0.1f, 0.1f}, {0.1f, 0.1f, 0.1f}};
    cloud.opacities = {0.25f, 1.f};
    cloud.shDegree = 1;
    for (int i = 0; i < 8; ++i) {
        cloud.coefficients.emplace_back(float(i), 0.5f, -float(i));
    }
    return cloud;
}

class Captures : public testing::Test {
protected:
    Captures() {
        registerSplatPlugins();
        _folder =
            std::filesystem::path(testing::TempDir()) / ("splats_" + std::to_string(std::random_device()()));
        std::filesystem::create_directories(_folder);
    }
    ~Captures() override { std::filesystem::remove_all(_folder); }

    std::string file(std::string const& name) const { return (_folder / name).string(); }
    std::string write(std::string const& name, std::string const& content) const {
        std::ofstream(file(name), std::ios::binary) << content;
        return file(name);
    }
    std::string capture(std::string const& name, hipr::SplatCloud const& cloud = twoSplats()) const {
        std::ostringstream content;
        writePly(cloud, content);
        return write(name, content.str());
    }

private:
    std::filesystem::path _folder;
};

template <class T>
T valueOf(UsdStageRefPtr const& stage, char const* attribute, char const* prim = "/Splats") {
    T value{};
    EXPECT_TRUE(stage->GetPrimAtPath(SdfPath(prim)).GetAttribute(TfToken(attribute)).Get(&value))
        << attribute;
    return value;
}

GfRange3d boundsOf(UsdStageRefPtr const& stage) {
    UsdGeomBBoxCache cache(UsdTimeCode::Default(), {TfToken("default")});
    return cache.ComputeWorldBound(stage->GetPseudoRoot()).ComputeAlignedRange();
}

TEST_F(Captures, openAsStages) {
    const UsdStageRefPtr stage = UsdStage::Open(capture("capture.ply"));
    ASSERT_TRUE(stage);
    EXPECT_EQ(stage->GetDefaultPrim().GetPath(), SdfPath("/Splats"));
    EXPECT_EQ(stage->GetDefaultPrim().GetTypeName(), "ParticleField3DGaussianSplat");
    EXPECT_EQ(valueOf<VtVec3fArray>(stage, "positions"), (VtVec3fArray{{1, 2, 3}, {-1, 0, 0}}));
    EXPECT_EQ(valueOf<VtQuatfArray>(stage, "orientations")[1], GfQuatf(1, 0, 0, 0));
    EXPECT_NEAR(valueOf<VtVec3fArray>(stage, "scales")[0][0], 0.5f, 1e-6f);
    EXPECT_EQ(valueOf<VtFloatArray>(stage, "opacities")[1], 1.f);
    EXPECT_EQ(valueOf<int>(stage, "radiance:sphericalHarmonicsDegree"), 1);
    EXPECT_EQ(valueOf<VtVec3fArray>(stage, "radiance:sphericalHarmonicsCoefficients")[7],
              GfVec3f(7, 0.5f, -7));
}

TEST_F(Captures, haveTheExtentOfTheirSplats) {
    const GfRange3d bounds = boundsOf(UsdStage::Open(capture("capture.ply")));
    // The first splat is turned by 90 degrees about Z; three standard deviations count.
    EXPECT_TRUE(GfIsClose(bounds.GetMax(), GfVec3d(1.3, 3.5, 3.3), 1e-4)) << bounds.GetMax();
    EXPECT_TRUE(GfIsClose(bounds.GetMin(), GfVec3d(-1.3, -0.3, -0.3), 1e-4)) << bounds.GetMin();
}

TEST_F(Captures, canBeTurnedUpright) {
    const std::string path = capture("capture.ply");
    const std::pair<char const*, GfVec3d> ups[] = {
        {"y", {1, 2, 3}}, {"-y", {1, -2, -3}}, {"z", {1, 3, -2}}, {"-z", {1, -3, 2}}};
    for (auto const& [up, expected] : ups) {
        const UsdStageRefPtr stage = UsdStage::Open(path + ":SDF_FORMAT_ARGS:up=" + up);
        ASSERT_TRUE(stage) << up;
        bool resets = false;
        GfMatrix4d transform;
        UsdGeomXformable(stage->GetDefaultPrim())
            .GetLocalTransformation(&transform, &resets, UsdTimeCode::Default());
        EXPECT_TRUE(GfIsClose(transform.Transform(GfVec3d(1, 2, 3)), expected, 1e-6)) << up;
    }
    TestWarnings warnings;
    EXPECT_TRUE(UsdStage::Open(path + ":SDF_FORMAT_ARGS:up=sideways"));
    EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("up=sideways")));
}

TEST_F(Captures, canBeReferencedAndOverridden) {
    capture("capture.ply");
    const std::string scene = write("scene.usda", R"(#usda 1.0
        def Xform "World" {
            def "Robot" (references = @./capture.ply@) {
                double3 xformOp:translate = (0, 10, 0)
                uniform token[] xformOpOrder = ["xformOp:translate"]
                float[] opacities = [0.5, 0.5]
            }
        })");
    const UsdStageRefPtr stage = UsdStage::Open(scene);
    ASSERT_TRUE(stage);
    SplatHost host(stage);
    const SyncedSplats splats = host.update().at("/World/Robot");
    ASSERT_TRUE(splats.cloud);
    EXPECT_EQ(splats.cloud->size(), 2u);
    EXPECT_EQ(splats.cloud->opacities, (std::vector<float>{0.5f, 0.5f}));
    EXPECT_EQ(splats.places, std::vector<GfVec3d>{GfVec3d(0, 10, 0)});
}

TEST_F(Captures, areWrittenAsTextOfUsd) {
    const SdfLayerRefPtr layer = SdfLayer::FindOrOpen(capture("capture.ply"));
    ASSERT_TRUE(layer);
    std::string text;
    ASSERT_TRUE(layer->ExportToString(&text));
    EXPECT_THAT(text, AllOf(HasSubstr("def ParticleField3DGaussianSplat \"Splats\""),
                            HasSubstr("point3f[] positions = [(1, 2, 3), (-1, 0, 0)]"),
                            HasSubstr("uniform int radiance:sphericalHarmonicsDegree = 1")));
}

TEST_F(Captures, thatAreBrokenSayWhyAndOpenNot) {
    capture("good.ply");
    std::ostringstream good;
    writePly(twoSplats(), good);
    const std::pair<std::string, char const*> files[] = {
        {write("cut.ply", good.str().substr(0, good.str().size() - 5)), "cut off"},
        {write("empty.ply", ""), "is empty"},
        {write("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n"),
         "lacks"},
        {write("text.spz", "hello"), "neither a .ply nor a .spz"}};
    for (auto const& [path, why] : files) {
        TfErrorMark errors;
        EXPECT_FALSE(UsdStage::Open(path)) << path;
        std::string told;
        for (TfError const& error : errors) {
            told += error.GetCommentary() + "\n";
        }
        errors.Clear();
        EXPECT_THAT(told, AllOf(HasSubstr(path), HasSubstr(why)));
    }
}

TEST_F(Captures, withBadSplatsSayHowMany) {
    hipr::SplatCloud cloud = twoSplats();
    cloud.positions[0].x = NAN;
    TestWarnings warnings;
    const UsdStageRefPtr stage = UsdStage::Open(capture("holes.ply", cloud));
    ASSERT_TRUE(stage);
    EXPECT_EQ(valueOf<VtVec3fArray>(stage, "positions").size(), 1u);
    EXPECT_THAT(warnings.texts(), ElementsAre(AllOf(HasSubstr("holes.ply"), HasSubstr("1 of 2 splats"))));
}

TEST_F(Captures, ofTheRealWorldArrive) {
    const std::string path = HIPR_ASSETS "/splats/playbot/playbot_8k_sh2.ply";
    if (!std::filesystem::exists(path)) {
        GTEST_SKIP() << path << " is not there";
    }
    SplatHost host(UsdStage::Open(path));
    auto const& synced = host.update();
    ASSERT_EQ(synced.size(), 1u);
    EXPECT_EQ(synced.at("/Splats").cloud->size(), 8406u);
    EXPECT_EQ(synced.at("/Splats").cloud->shDegree, 2u);
}

} // namespace
