/// ParticleField3DGaussianSplat prims in stages: the schema, and what of them arrives in Hydra.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pxr/base/gf/quatf.h"
#include "pxr/usd/usd/schemaRegistry.h"
#include "pxr/usd/usdGeom/bboxCache.h"
#include "pxr/usd/usdGeom/boundable.h"
#include "pxr/usd/usdGeom/gprim.h"
#include "pxr/usd/usdGeom/imageable.h"
#include "pxr/usd/usdGeom/xformCommonAPI.h"
#include "testenv/unit/delegate/test_warnings.h"
#include "testenv/unit/usdSplat/splat_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Vec3s = std::vector<glm::vec3>;

/// A stage with one prim, /World/Splats, of two splats.
UsdStageRefPtr stageOf(std::string const& attributes) {
    return splatStage("def Xform \"World\"\n{\ndef ParticleField3DGaussianSplat \"Splats\"\n{\n" +
                      attributes + "\n}\n}\n");
}
const char* const positions = "point3f[] positions = [(1, 2, 3), (4, 5, 6)]\n";
const SdfPath path("/World/Splats");

struct Prims : testing::Test {
    void TearDown() override { EXPECT_THAT(warnings.texts(), ElementsAre()); }
    TestWarnings warnings;
};

SyncedSplats only(std::map<std::string, SyncedSplats> const& synced) {
    EXPECT_EQ(synced.size(), 1u);
    return synced.empty() ? SyncedSplats() : synced.begin()->second;
}

TEST_F(Prims, areGprimsWithTheDefaultsOfUsdVol) {
    const UsdStageRefPtr stage = stageOf("");
    const UsdPrim prim = stage->GetPrimAtPath(path);
    EXPECT_TRUE(prim.IsA<UsdGeomGprim>());
    EXPECT_EQ(UsdSchemaRegistry::GetInstance().GetConcreteTypeFromSchemaTypeName(
                  TfToken("ParticleField3DGaussianSplat")),
              TfType::FindByName("UsdVolParticleField3DGaussianSplat"));
    int degree = -1;
    EXPECT_TRUE(prim.GetAttribute(TfToken("radiance:sphericalHarmonicsDegree")).Get(&degree));
    EXPECT_EQ(degree, 3);
    TfToken hint;
    EXPECT_TRUE(prim.GetAttribute(TfToken("sortingModeHint")).Get(&hint));
    EXPECT_EQ(hint, "zDepth");
    EXPECT_TRUE(prim.GetAttribute(TfToken("projectionModeHint")).Get(&hint));
    EXPECT_EQ(hint, "perspective");
    const std::pair<char const*, char const*> types[] = {
        {"positions", "point3f[]"},
        {"positionsh", "point3h[]"},
        {"orientations", "quatf[]"},
        {"orientationsh", "quath[]"},
        {"scales", "float3[]"},
        {"scalesh", "half3[]"},
        {"opacities", "float[]"},
        {"opacitiesh", "half[]"},
        {"radiance:sphericalHarmonicsCoefficients", "float3[]"},
        {"radiance:sphericalHarmonicsCoefficientsh", "half3[]"}};
    for (auto const& [name, type] : types) {
        EXPECT_EQ(prim.GetAttribute(TfToken(name)).GetTypeName().GetAsToken(), type) << name;
    }
}

TEST_F(Prims, arriveWithAllTheirValues) {
    const UsdStageRefPtr stage = stageOf(std::string(positions) + R"(
        quatf[] orientations = [(1, 0, 0, 0), (0, 0, 1, 0)]
        float3[] scales = [(1, 2, 3), (0.5, 0.25, 0)]
        float[] opacities = [0.25, 1]
        uniform int radiance:sphericalHarmonicsDegree = 1
        float3[] radiance:sphericalHarmonicsCoefficients = [(1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0),
                                                            (5, 0, 0), (6, 0, 0), (7, 0, 0), (8, 0, 0)]
        uniform token sortingModeHint = "rayHitDistance"
        uniform token projectionModeHint = "tangential")");
    SplatHost host(stage);
    const SyncedSplats synced = only(host.update());
    ASSERT_TRUE(synced.cloud);
    EXPECT_EQ(synced.cloud->name, "/World/Splats");
    EXPECT_EQ(synced.cloud->positions, (Vec3s{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(synced.cloud->orientations[1], glm::quat(0.f, 0.f, 1.f, 0.f));
    EXPECT_EQ(synced.cloud->scales, (Vec3s{{1, 2, 3}, {0.5f, 0.25f, 0}}));
    EXPECT_EQ(synced.cloud->opacities, (std::vector<float>{0.25f, 1.f}));
    EXPECT_EQ(synced.cloud->shDegree, 1u);
    EXPECT_EQ(synced.cloud->coefficients[6], glm::vec3(7, 0, 0));
    EXPECT_EQ(synced.cloud->sorting, hipr::SplatSorting::RayHitDistance);
    EXPECT_EQ(synced.cloud->projection, hipr::SplatProjection::Tangential);
}

TEST_F(Prims, mayLeaveOutAllButPositions) {
    SplatHost host(stageOf(positions));
    const SyncedSplats synced = only(host.update());
    ASSERT_TRUE(synced.cloud);
    EXPECT_EQ(synced.cloud->size(), 2u);
    EXPECT_TRUE(synced.cloud->scales.empty() && synced.cloud->coefficients.empty());
    EXPECT_EQ(synced.cloud->sorting, hipr::SplatSorting::ZDepth);
    SplatHost empty(stageOf(""));
    EXPECT_EQ(only(empty.update()).cloud->size(), 0u);
}

TEST_F(Prims, takeHalvesWhereFloatsAreMissing) {
    SplatHost host(stageOf(R"(
        point3h[] positionsh = [(1, 2, 3), (4, 5, 6)]
        quath[] orientationsh = [(0, 1, 0, 0), (1, 0, 0, 0)]
        half3[] scalesh = [(1, 1, 1), (2, 2, 2)]
        half[] opacitiesh = [0.5, 0.25]
        uniform int radiance:sphericalHarmonicsDegree = 0
        half3[] radiance:sphericalHarmonicsCoefficientsh = [(0.5, 0, 0), (0, 0.5, 0)]
        float3[] scales = [(7, 7, 7), (8, 8, 8)])"));
    const SyncedSplats synced = only(host.update());
    ASSERT_TRUE(synced.cloud);
    EXPECT_EQ(synced.cloud->positions[1], glm::vec3(4, 5, 6));
    EXPECT_EQ(synced.cloud->orientations[0], glm::quat(0.f, 1.f, 0.f, 0.f));
    EXPECT_EQ(synced.cloud->scales[0], glm::vec3(7)); // floats win
    EXPECT_EQ(synced.cloud->opacities[1], 0.25f);
    EXPECT_EQ(synced.cloud->coefficients[1], glm::vec3(0, 0.5f, 0));
}

TEST_F(Prims, moveInTime) {
    SplatHost host(splatStage(R"(
        def ParticleField3DGaussianSplat "Moving" {
            point3f[] positions.timeSamples = { 1: [(0, 0, 0)], 2: [(1, 0, 0), (2, 0, 0)] }
        }
        def ParticleField3DGaussianSplat "Still" {
            point3f[] positions = [(0, 0, 0)]
        })"));
    auto const& synced = host.update(1);
    EXPECT_EQ(synced.at("/Moving").cloud->positions, (Vec3s{{0, 0, 0}}));
    host.update(2);
    EXPECT_EQ(synced.at("/Moving").cloud->positions, (Vec3s{{1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(synced.at("/Moving").valueSyncs, 2);
    EXPECT_EQ(synced.at("/Still").syncs, 1);
}

TEST_F(Prims, haveTransformsVisibilityAndPurpose) {
    const UsdStageRefPtr stage = splatStage(R"(
        def Xform "World" {
            double3 xformOp:translate.timeSamples = { 1: (1, 0, 0), 2: (2, 0, 0) }
            uniform token[] xformOpOrder = ["xformOp:translate"]
            def ParticleField3DGaussianSplat "Splats" {
                point3f[] positions = [(0, 0, 0)]
                float xformOp:rotateX = 90
                uniform token[] xformOpOrder = ["xformOp:rotateX"]
                token visibility.timeSamples = { 1: "inherited", 2: "invisible" }
                uniform token purpose = "guide"
            }
        })");
    SplatHost host(stage);
    SyncedSplats synced = only(host.update(1));
    EXPECT_TRUE(synced.visible);
    EXPECT_EQ(synced.renderTag, HdRenderTagTokens->guide);
    EXPECT_EQ(synced.places, std::vector<GfVec3d>{GfVec3d(1, 0, 0)});
    EXPECT_TRUE(GfIsClose(synced.up, GfVec3d(0, 0, 1), 1e-6)) << synced.up;
    synced = only(host.update(2));
    EXPECT_EQ(synced.valueSyncs, 1);
    stage->GetPrimAtPath(path).GetAttribute(TfToken("visibility")).Clear();
    synced = only(host.update(2));
    EXPECT_TRUE(synced.visible);
    EXPECT_EQ(synced.places, std::vector<GfVec3d>{GfVec3d(2, 0, 0)});
}

TEST_F(Prims, areSyncedAgainAfterEdits) {
    const UsdStageRefPtr stage = stageOf(positions);
    SplatHost host(stage);
    EXPECT_EQ(only(host.update()).valueSyncs, 1);
    const UsdPrim prim = stage->GetPrimAtPath(path);
    const auto set = [&](char const* name, auto const& value) {
        ASSERT_TRUE(prim.GetAttribute(TfToken(name)).Set(value));
    };
    set("positions", VtVec3fArray{GfVec3f(9, 9, 9)});
    EXPECT_EQ(only(host.update()).cloud->positions, (Vec3s{{9, 9, 9}}));
    set("scales", VtVec3fArray{GfVec3f(2)});
    EXPECT_EQ(only(host.update()).cloud->scales, (Vec3s{{2, 2, 2}}));
    set("opacitiesh", VtHalfArray{GfHalf(0.5f)});
    EXPECT_EQ(only(host.update()).cloud->opacities, std::vector<float>{0.5f});
    set("opacities", VtFloatArray{0.25f});
    EXPECT_EQ(only(host.update()).cloud->opacities, std::vector<float>{0.25f});
    set("sortingModeHint", TfToken("cameraDistance"));
    EXPECT_EQ(only(host.update()).cloud->sorting, hipr::SplatSorting::CameraDistance);
    prim.GetAttribute(TfToken("scales")).Clear();
    EXPECT_TRUE(only(host.update()).cloud->scales.empty());

    const int values = only(host.update()).valueSyncs;
    UsdGeomXformCommonAPI(prim).SetTranslate(GfVec3d(0, 7, 0));
    EXPECT_EQ(only(host.update()).places, std::vector<GfVec3d>{GfVec3d(0, 7, 0)});
    UsdGeomImageable(prim).MakeInvisible();
    EXPECT_EQ(only(host.update()).valueSyncs, values);
    UsdGeomImageable(prim).MakeVisible();
    EXPECT_TRUE(only(host.update()).visible);
    EXPECT_LE(only(host.update()).valueSyncs, values + 1);

    stage->GetPrimAtPath(path).SetActive(false);
    EXPECT_TRUE(host.update().empty());
    stage->GetPrimAtPath(path).SetActive(true);
    EXPECT_EQ(only(host.update()).cloud->opacities, std::vector<float>{0.25f});
}

TEST_F(Prims, areInstancedByPointInstancers) {
    SplatHost host(splatStage(R"(
        def PointInstancer "Many" {
            int[] protoIndices = [0, 0, 0]
            point3f[] positions = [(1, 0, 0), (2, 0, 0), (3, 0, 0)]
            rel prototypes = </Many/Splats>
            def ParticleField3DGaussianSplat "Splats" {
                point3f[] positions = [(0.5, 0, 0)]
                float[] opacities = [0.5]
            }
        })"));
    const SyncedSplats synced = only(host.update());
    ASSERT_TRUE(synced.cloud);
    EXPECT_EQ(synced.cloud->positions, (Vec3s{{0.5f, 0, 0}}));
    EXPECT_EQ(synced.cloud->opacities, std::vector<float>{0.5f});
    EXPECT_THAT(synced.places, ElementsAre(GfVec3d(1, 0, 0), GfVec3d(2, 0, 0), GfVec3d(3, 0, 0)));
}

TEST_F(Prims, areInstancedByReferences) {
    const UsdStageRefPtr stage = splatStage(R"(
        class Xform "Model" {
            def ParticleField3DGaussianSplat "Splats" {
                point3f[] positions = [(0.5, 0, 0)]
                half[] opacitiesh = [0.5]
            }
        }
        def Xform "A" (
            instanceable = true
            references = </Model>
        ) {
            double3 xformOp:translate = (1, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }
        def Xform "B" (
            instanceable = true
            references = </Model>
        ) {
            double3 xformOp:translate = (2, 0, 0)
            uniform token[] xformOpOrder = ["xformOp:translate"]
        })");
    SplatHost host(stage);
    SyncedSplats synced = only(host.update());
    ASSERT_TRUE(synced.cloud);
    EXPECT_EQ(synced.cloud->opacities, std::vector<float>{0.5f});
    EXPECT_THAT(synced.places, testing::UnorderedElementsAre(GfVec3d(1, 0, 0), GfVec3d(2, 0, 0)));
    UsdGeomXformCommonAPI(stage->GetPrimAtPath(SdfPath("/B"))).SetTranslate(GfVec3d(5, 0, 0));
    synced = only(host.update());
    EXPECT_THAT(synced.places, testing::UnorderedElementsAre(GfVec3d(1, 0, 0), GfVec3d(5, 0, 0)));
}

const char* const fieldApis =
    "\"ParticleFieldPositionAttributeAPI\", \"ParticleFieldKernelGaussianEllipsoidAPI\", "
    "\"ParticleFieldSphericalHarmonicsAttributeAPI\"";

UsdStageRefPtr fieldStage(std::string const& apis) {
    const std::string metadata = apis.empty() ? "" : " (prepend apiSchemas = [" + apis + "])";
    return splatStage("def ParticleField \"Field\"" + metadata + "\n{\n" + positions +
                      "float[] opacities = [0.25, 1]\n}\n");
}

TEST_F(Prims, mayBeBareFieldsWithTheSchemasOfSplats) {
    const UsdStageRefPtr stage = fieldStage(fieldApis);
    SplatHost host(stage);
    const SyncedSplats splats = only(host.update());
    ASSERT_TRUE(splats.cloud);
    EXPECT_EQ(splats.cloud->positions, (Vec3s{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_THAT(splats.cloud->opacities, ElementsAre(0.25f, 1.f));
}

TEST(SplatPrims, thatAreOtherFieldsAreNotDrawnAndSaySoOnce) {
    for (auto const& [apis, why] :
         {std::pair("", "does not apply ParticleFieldPositionAttributeAPI"),
          std::pair("\"ParticleFieldPositionAttributeAPI\", \"ParticleFieldKernelGaussianEllipsoidAPI\"",
                    "does not apply ParticleFieldSphericalHarmonicsAttributeAPI"),
          std::pair("\"ParticleFieldPositionAttributeAPI\", \"ParticleFieldKernelGaussianSurfletAPI\", "
                    "\"ParticleFieldSphericalHarmonicsAttributeAPI\"",
                    "has particles of another kernel, ParticleFieldKernelGaussianSurfletAPI")}) {
        TestWarnings warnings;
        const UsdStageRefPtr stage = fieldStage(apis);
        SplatHost host(stage), again(stage);
        EXPECT_TRUE(host.update().empty()) << apis;
        EXPECT_TRUE(again.update().empty()) << apis;
        EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("/Field: " + std::string(why))));
    }
}

TEST_F(Prims, haveAnExtentThoughNoneIsAuthored) {
    const UsdStageRefPtr stage = stageOf(std::string(positions) + R"(
        half3[] scalesh = [(1, 2, 3), (0.5, 0.25, 0)]
        quatf[] orientations = [(1, 0, 0, 0), (0, 0, 0, 1)]
        double3 xformOp:translate = (10, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"])");
    UsdGeomBBoxCache cache(UsdTimeCode::Default(), {UsdGeomTokens->default_});
    const GfRange3d box = cache.ComputeWorldBound(stage->GetPrimAtPath(path)).ComputeAlignedRange();
    EXPECT_LT((box.GetMin() - GfVec3d(8, -4, -6)).GetLength(), 1e-5);
    EXPECT_LT((box.GetMax() - GfVec3d(15.5, 8, 12)).GetLength(), 1e-5);
    VtVec3fArray turned;
    const UsdGeomBoundable prim(stage->GetPrimAtPath(path));
    ASSERT_TRUE(UsdGeomBoundable::ComputeExtentFromPlugins(
        prim, UsdTimeCode::Default(), GfMatrix4d().SetScale(GfVec3d(-1, 1, 2)), &turned));
    EXPECT_LT((turned[0] - GfVec3f(-5.5f, -4, -12)).GetLength(), 1e-5f);
    EXPECT_LT((turned[1] - GfVec3f(2, 8, 24)).GetLength(), 1e-5f);
}

TEST(SplatPrims, withArraysOfOtherLengthsSayThatOnce) {
    TestWarnings warnings;
    SplatHost host(stageOf(std::string(positions) +
                           "float[] opacities = [1]\nfloat3[] scales = [(1, 1, 1), (1, 1, 1), (3, 3, 3)]"));
    const SyncedSplats synced = only(host.update());
    EXPECT_TRUE(synced.cloud->opacities.empty());
    EXPECT_EQ(synced.cloud->scales.size(), 2u);
    EXPECT_THAT(warnings.texts(),
                testing::UnorderedElementsAre(HasSubstr("</World/Splats>: 'opacities' has 1 values"),
                                              HasSubstr("</World/Splats>: 'scales' has 3 values")));
}

} // namespace
