/// What a scene asks for and does not get is named once, with its prim; what nobody asks for is not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Messages are said once in the life of a process, so every test has prims of its own name.
struct Unsupported : testing::Test {
    Unsupported() : host({"color"}, 1) {
        host.setViewSize(3.0);
        host.scene().addDome(SdfPath("/dome"));
    }
    TestScene::Prim& square(char const* name) { return host.scene().addSquare(SdfPath(name), GfVec3f(0.5f)); }
    void openShutter(char const* camera) {
        auto& params = host.scene().addCamera(SdfPath(camera), 3.0).params;
        params[TfToken("shutterOpen")] = VtValue(-0.25);
        params[TfToken("shutterClose")] = VtValue(0.25);
    }

    TestHost host;
    TestWarnings warnings;
};

TEST_F(Unsupported, cullStylesOfPrims) {
    square("/cull_nothing").cullStyle = HdCullStyleNothing;
    square("/cull_back").cullStyle = HdCullStyleBack;
    square("/cull_front").cullStyle = HdCullStyleFrontUnlessDoubleSided;
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), testing::UnorderedElementsAre(
                                      AllOf(HasSubstr("</cull_back>"), HasSubstr("all faces are drawn")),
                                      HasSubstr("</cull_front>")));
    host.scene().tracker().MarkRprimDirty(SdfPath("/cull_back"), HdChangeTracker::DirtyCullStyle);
    ASSERT_TRUE(host.render());
    EXPECT_EQ(warnings.texts().size(), 2u);
}

TEST_F(Unsupported, aCullStyleOfTheView) {
    square("/seen");
    host.state().SetCullStyle(HdCullStyleBackUnlessDoubleSided);
    ASSERT_TRUE(host.render());
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("culling faces")));
}

TEST_F(Unsupported, motionWhileAShutterIsOpen) {
    openShutter("/open_camera");
    square("/still");
    square("/moving").shutterMotion.SetTranslate(GfVec3d(0.1, 0, 0));
    square("/deforming").primvarsAtClose[HdTokens->points] =
        VtValue(VtVec3fArray{{-0.5f, -0.5f, 1}, {0.5f, -0.5f, 1}, {0.5f, 0.5f, 1}, {-0.5f, 0.5f, 1}});
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(),
                testing::UnorderedElementsAre(AllOf(HasSubstr("</moving>"), HasSubstr("motion blur")),
                                              HasSubstr("</deforming>")));
}

TEST_F(Unsupported, motionOfInstancesWhileAShutterIsOpen) {
    openShutter("/open_camera");
    const VtVec3fArray here{GfVec3f(0.f)}, there{GfVec3f(1.f)};
    for (const char* name : {"/still_instancer", "/moving_instancer", "/scattering_instancer"}) {
        const SdfPath instancer(name), prototype = instancer.AppendChild(TfToken("prototype"));
        auto& prim = host.scene().addInstancer(instancer, prototype, here);
        prim.primvars[TfToken("tint")] = {HdInterpolationInstance, VtValue(VtFloatArray{1.f})};
        prim.primvarsAtClose[TfToken("tint")] = VtValue(VtFloatArray{2.f});
        host.scene().addSquare(prototype, GfVec3f(0.5f), instancer);
    }
    host.scene().prim(SdfPath("/moving_instancer")).shutterMotion.SetTranslate(GfVec3d(0.1, 0, 0));
    host.scene().prim(SdfPath("/scattering_instancer")).primvarsAtClose[TfToken("translate")] =
        VtValue(there);
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), testing::UnorderedElementsAre(HasSubstr("</moving_instancer>"),
                                                                HasSubstr("</scattering_instancer>")));
}

TEST_F(Unsupported, noMotionWhileEveryShutterIsClosed) {
    openShutter("/closing_camera");
    host.scene().addCamera(SdfPath("/closed_camera"), 3.0);
    host.scene().remove(SdfPath("/closing_camera"));
    square("/moving_unseen").shutterMotion.SetTranslate(GfVec3d(0.1, 0, 0));
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

} // namespace
