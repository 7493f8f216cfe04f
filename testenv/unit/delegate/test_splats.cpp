/// Clouds of splats through Hydra: what reaches the renderer, and what is said of values that do not fit.
#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plugin/hdHipr/splatCloud.h"
#include "pxr/base/gf/half.h"
#include "pxr/base/gf/quatf.h"
#include "pxr/base/gf/quath.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/base/gf/vec3h.h"
#include "pxr/imaging/hd/camera.h"
#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Messages are said once in the life of a process, so every test has prims of its own name.
struct Splats : testing::Test {
    Splats() : host({"color"}, 1) {}

    TestScene::Prim& add(char const* name) {
        path = SdfPath(name);
        return host.scene().addSplats(path, GfVec3f(0.8f, 0.5f, 0.2f));
    }
    void set(char const* name, VtValue value) {
        host.scene().prim(path).primvars[TfToken(name)] = {HdInterpolationVertex, std::move(value)};
    }
    std::shared_ptr<const hipr::SplatCloud> cloud() { return hdhipr::readSplatCloud(host.scene(), path); }
    std::string dump() {
        return host.delegate().GetRenderSetting(TfToken("hipr:sceneDump")).Get<std::string>();
    }

    TestHost host;
    SdfPath path;
    TestWarnings warnings;
};

const char* const coefficients = "radiance:sphericalHarmonicsCoefficients";
const char* const degree = "radiance:sphericalHarmonicsDegree";

TEST_F(Splats, valuesArriveAsTheyAre) {
    add("/plain");
    set("positions", VtValue(VtVec3fArray{{1, 2, 3}, {4, 5, 6}}));
    set("orientations", VtValue(VtQuatfArray{GfQuatf(1, 0, 0, 0), GfQuatf(0, GfVec3f(0, 2, 0))}));
    set("scales", VtValue(VtVec3fArray{{1, 2, 3}, {0.5f, 0.25f, 0}}));
    set("opacities", VtValue(VtFloatArray{0.25f, 1.f}));
    set(degree, VtValue(1));
    set(coefficients, VtValue(VtVec3fArray(8, GfVec3f(0.1f, 0.2f, 0.3f))));
    const auto read = cloud();
    EXPECT_EQ(read->name, "/plain");
    EXPECT_EQ(read->positions, (std::vector<glm::vec3>{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(read->orientations[1], glm::quat(0.f, 0.f, 1.f, 0.f)); // of unit length
    EXPECT_EQ(read->scales[1], glm::vec3(0.5f, 0.25f, 0));
    EXPECT_EQ(read->opacities, (std::vector<float>{0.25f, 1.f}));
    EXPECT_EQ(read->shDegree, 1u);
    EXPECT_EQ(read->coefficients, std::vector<glm::vec3>(8, glm::vec3(0.1f, 0.2f, 0.3f)));
    EXPECT_EQ(read->sorting, hipr::SplatSorting::ZDepth);
    EXPECT_EQ(read->projection, hipr::SplatProjection::Perspective);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Splats, halvesAndDoublesAreFloats) {
    add("/halves");
    set("positions", VtValue(VtVec3hArray{GfVec3h(1, 2, 3), GfVec3h(4, 5, 6)}));
    set("orientations", VtValue(VtQuathArray{GfQuath(1, 0, 0, 0), GfQuath(0, GfVec3h(1, 0, 0))}));
    set("scales", VtValue(VtVec3dArray{GfVec3d(1, 2, 3), GfVec3d(1)}));
    set("opacities", VtValue(VtHalfArray{GfHalf(0.5f), GfHalf(1.f)}));
    set(coefficients, VtValue(VtVec3hArray(2, GfVec3h(0.5f))));
    const auto read = cloud();
    EXPECT_EQ(read->positions[1], glm::vec3(4, 5, 6));
    EXPECT_EQ(read->orientations[1], glm::quat(0.f, 1.f, 0.f, 0.f));
    EXPECT_EQ(read->scales[0], glm::vec3(1, 2, 3));
    EXPECT_EQ(read->opacities[0], 0.5f);
    EXPECT_EQ(read->coefficients[1], glm::vec3(0.5f));
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Splats, whatIsNotThereHasTheDefaults) {
    auto& prim = add("/bare");
    const TestScene::Primvar positions = prim.primvars[TfToken("positions")];
    prim.primvars = {{TfToken("positions"), positions}};
    auto read = cloud();
    EXPECT_EQ(read->size(), 2u);
    EXPECT_TRUE(read->orientations.empty() && read->scales.empty() && read->opacities.empty());
    EXPECT_TRUE(read->coefficients.empty());
    EXPECT_EQ(read->shDegree, 0u);
    prim.primvars.clear();
    EXPECT_EQ(cloud()->size(), 0u);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Splats, hintsAreTaken) {
    add("/hints");
    set("sortingModeHint", VtValue(TfToken("cameraDistance")));
    set("projectionModeHint", VtValue(TfToken("tangential")));
    EXPECT_EQ(cloud()->sorting, hipr::SplatSorting::CameraDistance);
    EXPECT_EQ(cloud()->projection, hipr::SplatProjection::Tangential);
    set("sortingModeHint", VtValue(TfToken("rayHitDistance")));
    EXPECT_EQ(cloud()->sorting, hipr::SplatSorting::RayHitDistance);
    set("sortingModeHint", VtValue(TfToken("zDepth")));
    EXPECT_EQ(cloud()->sorting, hipr::SplatSorting::ZDepth);
}

TEST_F(Splats, longArraysAreCutAndShortOnesLeftOut) {
    add("/lengths");
    set("scales", VtValue(VtVec3fArray{{1, 1, 1}, {2, 2, 2}, {3, 3, 3}}));
    set("opacities", VtValue(VtFloatArray{0.5f}));
    set(degree, VtValue(1));
    set(coefficients, VtValue(VtVec3fArray(5, GfVec3f(1.f))));
    const auto read = cloud();
    EXPECT_EQ(read->scales, (std::vector<glm::vec3>{glm::vec3(1), glm::vec3(2)}));
    EXPECT_TRUE(read->opacities.empty());
    EXPECT_TRUE(read->coefficients.empty());
    EXPECT_EQ(read->shDegree, 0u);
    cloud();
    EXPECT_THAT(
        warnings.texts(),
        testing::UnorderedElementsAre(
            AllOf(HasSubstr("</lengths>: 'scales' has 3 values instead of 2"), HasSubstr("last ones")),
            AllOf(HasSubstr("'opacities' has 1 values instead of 2"), HasSubstr("not used")),
            HasSubstr("Coefficients' has 5 values instead of 8")));
}

TEST_F(Splats, valuesOfTheWrongTypeAreNamed) {
    add("/types");
    set("scales", VtValue(VtStringArray{"a", "b"}));
    set("opacities", VtValue(0.5f));
    set(degree, VtValue(7));
    const auto read = cloud();
    EXPECT_TRUE(read->scales.empty() && read->opacities.empty() && read->coefficients.empty());
    EXPECT_THAT(warnings.texts(), testing::UnorderedElementsAre(HasSubstr("'scales' is of type"),
                                                                HasSubstr("'opacities' is of type"),
                                                                HasSubstr("is 7 instead of 0 to 3")));
}

TEST_F(Splats, whatIsNoSplatIsLeftOutAndTheRestDrawn) {
    add("/broken");
    set("positions", VtValue(VtVec3fArray{{0, 0, NAN}, {0.25f, 0, 0}}));
    add("/whole");
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("</broken>: 1 of 2 splats")));
    EXPECT_THAT(dump(), AllOf(HasSubstr("/broken"), HasSubstr("/whole")));
}

TEST_F(Splats, whatIsRemovedLeavesTheRenderer) {
    add("/leaving");
    ASSERT_TRUE(host.render());
    EXPECT_THAT(dump(), HasSubstr("/leaving"));
    host.scene().remove(path);
    ASSERT_TRUE(host.render());
    EXPECT_THAT(dump(), Not(HasSubstr("/leaving")));
}

/// The shutter is open for the frame that the scene shows.
struct MovingSplats : Splats {
    static constexpr double viewSize = 3.0;

    MovingSplats() {
        host.scene().addCamera(eye, viewSize).transform.SetTranslate(GfVec3d(0, 0, 10));
        host.setCamera(eye);
        setShutter(1.0);
    }
    void setShutter(double close) {
        host.scene().prim(eye).params[TfToken("shutterClose")] = VtValue(close);
        host.scene().tracker().MarkSprimDirty(eye, HdCamera::DirtyParams);
    }
    static GfMatrix4d right(double x) { return GfMatrix4d(1.0).SetTranslate(GfVec3d(x, 0, 0)); }
    /// The alpha of the picture's middle row.
    std::vector<float> row() {
        EXPECT_TRUE(host.render());
        std::vector<float> values;
        for (int x = 0; x < TestHost::width; ++x) {
            values.push_back(host.readColor((x + 0.5) / TestHost::width - 0.5, 0.01)[3]);
        }
        return values;
    }
    static double largestDifference(std::vector<float> const& a, std::vector<float> const& b) {
        double largest = 0.0;
        for (size_t i = 0; i < a.size(); ++i) {
            largest = std::max(largest, std::abs(double(a[i]) - double(b[i])));
        }
        return largest;
    }
    /// Of splats that go a unit to the right.
    std::vector<float> meanOfMoments() {
        constexpr int moments = 32;
        setShutter(0.0);
        std::vector<float> mean(TestHost::width, 0.f);
        for (int i = 0; i < moments; ++i) {
            host.scene().prim(path).transform = right((i + 0.5) / moments);
            host.scene().tracker().MarkRprimDirty(path, HdChangeTracker::DirtyTransform);
            const std::vector<float> moment = row();
            for (size_t x = 0; x < mean.size(); ++x) {
                mean[x] += moment[x] / moments;
            }
        }
        return mean;
    }

    const SdfPath eye{"/eye"};
};

TEST_F(MovingSplats, areTheMeanOfTheirMoments) {
    add("/moving").shutterMotion = right(1);
    const std::vector<float> blurred = row();
    host.scene().prim(path).shutterMotion = GfMatrix4d(1.0);
    host.scene().tracker().MarkRprimDirty(path, HdChangeTracker::DirtyTransform);
    EXPECT_GT(largestDifference(row(), blurred), 0.2);
    EXPECT_LT(largestDifference(meanOfMoments(), blurred), 0.02);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(MovingSplats, areTheSameWhenTheCameraMoves) {
    add("/still");
    host.scene().prim(eye).shutterMotion = right(-1);
    const std::vector<float> blurred = row();
    host.scene().prim(eye).shutterMotion = GfMatrix4d(1.0);
    EXPECT_LT(largestDifference(meanOfMoments(), blurred), 0.02);
}

TEST_F(MovingSplats, areNotBlurredWhereThatIsOff) {
    add("/off").shutterMotion = right(1);
    const std::vector<float> blurred = row();
    host.delegate().SetRenderSetting(TfToken("enableMotionBlur"), VtValue(false));
    const std::vector<float> off = row();
    EXPECT_GT(largestDifference(off, blurred), 0.2);
    host.delegate().SetRenderSetting(TfToken("enableMotionBlur"), VtValue(true));
    EXPECT_EQ(row(), blurred);
    setShutter(0.0);
    EXPECT_EQ(row(), off);
}

TEST_F(Splats, motionOfTheirPositionsIsNamed) {
    auto& params = host.scene().addCamera(SdfPath("/splat_camera"), 3.0).params;
    params[TfToken("shutterOpen")] = VtValue(-0.25);
    params[TfToken("shutterClose")] = VtValue(0.25);
    add("/still_splats");
    add("/moving_splats").primvarsAtClose[TfToken("positions")] =
        VtValue(VtVec3fArray{{-0.25f, 0, 1}, {0.25f, 0, 1}});
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(),
                ElementsAre(AllOf(HasSubstr("</moving_splats>"), HasSubstr("which is not blurred"))));
}

} // namespace
