/// Motion blur: what moves while the shutter of the camera is open covers each place for the time it is
/// there.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pxr/imaging/hd/camera.h"
#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const SdfPath eye("/eye");

/// The scene tells where things are at 0 and at 1 frames, which is when the shutter opens and closes.
struct Motion : testing::Test {
    static constexpr double viewSize = 4.0;

    Motion() : host({"color"}, 64) {
        host.scene().addCamera(eye, viewSize).transform.SetTranslate(GfVec3d(0, 0, 10));
        host.setCamera(eye);
        setShutter(0.0, 1.0);
    }
    void setShutter(double open, double close) {
        auto& params = host.scene().prim(eye).params;
        params[TfToken("shutterOpen")] = VtValue(open);
        params[TfToken("shutterClose")] = VtValue(close);
        host.scene().tracker().MarkSprimDirty(eye, HdCamera::DirtyParams);
    }
    static GfMatrix4d right(double x) { return GfMatrix4d(1.0).SetTranslate(GfVec3d(x, 0, 0)); }
    static VtValue pointsAt(float x) {
        return VtValue(VtVec3fArray{
            {x - 0.5f, -0.5f, 0}, {x + 0.5f, -0.5f, 0}, {x + 0.5f, 0.5f, 0}, {x - 0.5f, 0.5f, 0}});
    }
    double coverage(double x) { return host.readColor(x / viewSize, 0)[3]; }
    /// Of a unit square in the middle that goes `way` to the right, a unit at most.
    void expectMoved(double way = 1.0) {
        ASSERT_TRUE(host.render());
        for (double x = -0.9; x < 1.9; x += 0.2) {
            const double covered = (std::min(x + 0.5, way) - std::max(x - 0.5, 0.0)) / way;
            EXPECT_NEAR(coverage(x), std::clamp(covered, 0.0, 1.0), 0.12 / way) << x;
        }
    }
    void expectStill() {
        ASSERT_TRUE(host.render());
        EXPECT_EQ(coverage(-0.3), 1.0);
        EXPECT_EQ(coverage(0.3), 1.0);
        EXPECT_EQ(coverage(0.8), 0.0);
    }

    TestHost host;
    TestWarnings warnings;
};

TEST_F(Motion, ofATransform) {
    host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f)).shutterMotion = right(1);
    expectMoved();
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Motion, ofPoints) {
    host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f)).primvarsAtClose[HdTokens->points] = pointsAt(1);
    expectMoved();
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Motion, ofInstancersOfAllLevels) {
    const SdfPath outer("/outer"), inner("/outer/inner"), square("/outer/inner/square");
    const TfToken translate("translate");
    host.scene().addInstancer(outer, inner, {GfVec3f(0.f)});
    host.scene().addInstancer(inner, square, {GfVec3f(0.f)}, outer);
    auto& prim = host.scene().addSquare(square, GfVec3f(0.5f), inner);
    prim.shutterMotion = right(0.25);
    host.scene().prim(inner).primvarsAtClose[translate] = VtValue(VtVec3fArray{{0.25f, 0, 0}});
    host.scene().prim(outer).primvarsAtClose[translate] = VtValue(VtVec3fArray{{0.25f, 0, 0}});
    host.scene().prim(outer).shutterMotion = right(0.25);
    expectMoved();
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Motion, ofTheCamera) {
    host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
    host.scene().prim(eye).shutterMotion = right(-1);
    expectMoved();
}

TEST_F(Motion, ofPointsThatAreBalls) {
    auto& ball = host.scene().addPoints(SdfPath("/balls"), {GfVec3f(0.5f), GfVec3f(0.5f)});
    VtVec3fArray there = ball.primvars[HdTokens->points].value.Get<VtVec3fArray>();
    ASSERT_TRUE(host.render());
    const double before = coverage(there[0][0]);
    there[0][0] += 2.f;
    ball.primvarsAtClose[HdTokens->points] = VtValue(there);
    host.scene().tracker().MarkRprimDirty(SdfPath("/balls"), HdChangeTracker::DirtyPoints);
    ASSERT_TRUE(host.render());
    EXPECT_GT(before, 0.9); // the pixel filter reaches beyond the ball
    EXPECT_LT(coverage(there[0][0] - 2.f), 0.6);
    EXPECT_GT(coverage(there[0][0] - 1.f), 0.05);
}

TEST_F(Motion, isThatOfTheShutter) {
    host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f)).shutterMotion = right(1);
    setShutter(0.0, 0.5);
    expectMoved(0.5);
    setShutter(0.0, 0.0);
    expectStill();
    setShutter(0.0, 1.0);
    expectMoved();
    host.delegate().SetRenderSetting(TfToken("enableMotionBlur"), VtValue(false));
    expectStill();
}

TEST_F(Motion, doesNotDeformWhatChangesItsTopology) {
    host.scene().addSquare(SdfPath("/changing"), GfVec3f(0.5f)).primvarsAtClose[HdTokens->points] =
        VtValue(VtVec3fArray{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 2}});
    expectStill();
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("</changing>: its topology changes")));
}

} // namespace
