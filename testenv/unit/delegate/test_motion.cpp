/// Motion blur: what moves while the shutter of the camera is open covers each place for the time it is
/// there.
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pxr/imaging/hd/camera.h"
#include "testenv/unit/delegate/test_host.h"
#include "testenv/unit/delegate/test_warnings.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

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

/// To the right in units a frame, for each of so many.
VtValue velocities(size_t count, double unitsAFrame, double framesPerSecond = 24.0) {
    return VtValue(VtVec3fArray(count, GfVec3f(float(unitsAFrame * framesPerSecond), 0, 0)));
}

TEST_F(Motion, ofPointsByVelocities) {
    auto& square = host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
    square.primvars[HdTokens->velocities] = {HdInterpolationVertex, velocities(4, 1.0)};
    square.primvarsAtClose[HdTokens->points] = pointsAt(-1); // does not count then
    expectMoved();
    host.delegate().SetRenderSetting(TfToken("hipr:framesPerSecond"), VtValue(48.0));
    expectMoved(0.5);
    square.primvars[HdTokens->velocities].value = velocities(4, 0.25, 48.0);
    host.scene().tracker().MarkRprimDirty(SdfPath("/square"), HdChangeTracker::DirtyPoints);
    expectMoved(0.25);
    square.primvars.erase(HdTokens->velocities);
    square.primvarsAtClose.clear();
    host.scene().tracker().MarkRprimDirty(SdfPath("/square"), HdChangeTracker::DirtyPoints);
    expectStill();
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Motion, byVelocitiesGoesOnFromTheFrame) {
    auto& square = host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
    square.primvars[HdTokens->velocities] = {HdInterpolationVertex, velocities(4, 1.0)};
    square.primvars[HdTokens->points].value = pointsAt(1.f);
    setShutter(-1.0, 0.0);
    expectMoved();
}

TEST_F(Motion, byAccelerationsIsAParabola) {
    auto& square = host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
    square.primvars[HdTokens->velocities] = {HdInterpolationVertex, velocities(4, 0.0)};
    square.primvars[HdTokens->accelerations] = {HdInterpolationVertex, velocities(4, 2.0, 24.0 * 24.0)};
    ASSERT_TRUE(host.render());
    for (const double x : {-0.8125, -0.1875, 0.0625, 0.3125, 0.8125, 1.0625, 1.3125}) { // it is at t * t
        const double comes = std::sqrt(std::clamp(x - 0.5, 0.0, 1.0)),
                     goes = std::sqrt(std::clamp(x + 0.5, 0.0, 1.0));
        EXPECT_NEAR(coverage(x), goes - comes, 0.12) << x; // a straight way would give 0.31 at -0.1875
    }
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

/// Of points that go a unit to the right, once by samples and once by velocities.
void expectAlike(TestHost& host, TestScene::Prim& prim, SdfPath const& id) {
    const auto row = [&] {
        std::vector<GfVec4f> pixels;
        for (double x = -0.49; x < 0.5; x += 0.03) {
            pixels.push_back(host.readColor(x, 0));
        }
        return pixels;
    };
    VtVec3fArray points = prim.primvars[HdTokens->points].value.Get<VtVec3fArray>();
    ASSERT_TRUE(host.render());
    const auto still = row();
    for (GfVec3f& point : points) {
        point[0] += 1.f;
    }
    prim.primvarsAtClose[HdTokens->points] = VtValue(points);
    host.scene().tracker().MarkRprimDirty(id, HdChangeTracker::DirtyPoints);
    ASSERT_TRUE(host.render());
    const auto sampled = row();
    prim.primvarsAtClose.clear();
    prim.primvars[HdTokens->velocities] = {HdInterpolationVertex, velocities(points.size(), 1.0)};
    host.scene().tracker().MarkRprimDirty(id, HdChangeTracker::DirtyPoints);
    ASSERT_TRUE(host.render());
    EXPECT_NE(sampled, still);
    EXPECT_EQ(row(), sampled);
}

TEST_F(Motion, ofCurvesByVelocities) {
    expectAlike(host, host.scene().addCurve(SdfPath("/curve"), GfVec3f(0.5f)), SdfPath("/curve"));
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Motion, ofBallsByVelocities) {
    const VtVec3fArray colors{GfVec3f(0.5f), GfVec3f(0.5f)};
    expectAlike(host, host.scene().addPoints(SdfPath("/balls"), colors), SdfPath("/balls"));
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

/// Hosts name the velocities of instances as primvars of theirs; UsdImaging of 20.08 only gives them to who
/// asks.
TEST_F(Motion, ofInstancersByVelocities) {
    const SdfPath instancer("/instancer"), square("/instancer/square");
    auto& placing = host.scene().addInstancer(instancer, square, {GfVec3f(0.f)});
    host.scene().addSquare(square, GfVec3f(0.5f), instancer);
    placing.primvars[HdTokens->velocities] = {HdInterpolationInstance, velocities(1, 1.0)};
    placing.primvarsAtClose[TfToken("translate")] = VtValue(VtVec3fArray{{-1, 0, 0}}); // does not count then
    expectMoved();
    placing.primvars.erase(HdTokens->velocities);
    placing.params[HdTokens->velocities] = velocities(1, 0.5);
    host.scene().tracker().MarkInstancerDirty(instancer, HdChangeTracker::DirtyPrimvar);
    expectMoved(0.5);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Motion, ofInstancersThatSpin) {
    const SdfPath instancer("/instancer"), square("/instancer/square");
    auto& placing = host.scene().addInstancer(instancer, square, {GfVec3f(0.f)});
    placing.primvars[TfToken("rotate")] = {HdInterpolationInstance, VtValue(VtVec4fArray{{1, 0, 0, 0}})};
    placing.primvars[TfToken("angularVelocities")] = {HdInterpolationInstance,
                                                      VtValue(VtVec3fArray{{0, 0, 360.f * 24.f}})};
    host.scene().addSquare(square, GfVec3f(0.5f), instancer);
    ASSERT_TRUE(host.render());
    EXPECT_GT(coverage(0.3), 0.99);
    // The corners of a unit square that turns sweep a ring; here between the directions of four.
    const double radius = 0.5625, corner = std::acos(0.5 / radius);
    EXPECT_NEAR(coverage(radius), 1.0 - 8.0 * corner / (2.0 * M_PI), 0.12);
    EXPECT_NEAR(host.readColor(0, radius / viewSize)[3], 1.0 - 8.0 * corner / (2.0 * M_PI), 0.12);
    EXPECT_LT(coverage(0.8), 0.05);
    EXPECT_THAT(warnings.texts(), ElementsAre());
}

TEST_F(Motion, byVelocitiesWithoutOneForEachIsTold) {
    auto& square = host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
    square.primvars[HdTokens->velocities] = {HdInterpolationVertex, velocities(3, 1.0)};
    expectStill();
    square.primvars[HdTokens->velocities].value =
        VtValue(VtVec3fArray(4, GfVec3f(std::numeric_limits<float>::infinity())));
    host.scene().tracker().MarkRprimDirty(SdfPath("/square"), HdChangeTracker::DirtyPoints);
    expectStill();
    EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("</square>: it has 3 velocities where 4 are wanted"),
                                              HasSubstr("</square>: some of its velocities are no numbers")));
}

TEST_F(Motion, byVelocitiesThatDoNotFitIsToldOnceOfEveryPrim) {
    const SdfPath placing("/placing"), square("/placing/square"), curve("/curve"), balls("/balls");
    const TestScene::Primvar one{HdInterpolationVertex, velocities(1, 1.0)};
    const float nan = std::nanf("");
    host.scene().addInstancer(placing, square, {GfVec3f(0.f), GfVec3f(1, 0, 0)});
    auto& placed = host.scene().addSquare(square, GfVec3f(0.5f), placing);
    placed.primvars[HdTokens->velocities] = {HdInterpolationVertex, velocities(4, 1.0)};
    placed.primvars[HdTokens->accelerations] = {HdInterpolationVertex,
                                                VtValue(VtVec3fArray(4, GfVec3f(nan)))};
    auto& placings = host.scene().prim(placing).primvars;
    placings[HdTokens->velocities] = {HdInterpolationInstance, velocities(1, 1.0)};
    placings[TfToken("rotate")] = {HdInterpolationInstance, VtValue(VtVec4fArray(2, GfVec4f(1, 0, 0, 0)))};
    placings[TfToken("angularVelocities")] = {HdInterpolationInstance, velocities(1, 1.0)};
    host.scene().addCurve(curve, GfVec3f(0.5f)).primvars[HdTokens->velocities] = {HdInterpolationVertex,
                                                                                  velocities(1, 1.0)};
    host.scene().addPoints(balls, VtVec3fArray(2, GfVec3f(0.5f))).primvars[HdTokens->accelerations] = one;
    ASSERT_TRUE(host.render());
    EXPECT_THAT(warnings.texts(),
                UnorderedElementsAre(HasSubstr("</placing/square>: some of its accelerations are no numbers"),
                                     HasSubstr("</placing>: it has 1 velocities where 2 are wanted"),
                                     HasSubstr("</placing>: it has 1 angularVelocities where 2 are wanted"),
                                     HasSubstr("</curve>: it has 1 velocities where 3"),
                                     HasSubstr("</balls>: it has 1 accelerations where 2 are wanted")));
}

/// As a host tells it where Hydra has no samples of what computations read.
TEST_F(Motion, ofComputedPoints) {
    const SdfPath square("/square"), computation("/square/skin");
    auto& prim = host.scene().addSquare(square, GfVec3f(0.5f));
    host.scene().addComputation(computation);
    prim.computation = computation;
    expectStill();
    EXPECT_THAT(warnings.texts(), ElementsAre(HasSubstr("</square>: its points are computed")));
    const TfToken samples("hipr:computed:points");
    prim.params[samples] = pointsAt(0);
    prim.primvarsAtClose[samples] = pointsAt(1);
    host.scene().tracker().MarkRprimDirty(square, HdChangeTracker::DirtyPoints);
    expectMoved();
    EXPECT_EQ(warnings.texts().size(), 1u);
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
