/// Hosts without camera prims: view and projection are all they have (a viewport's free camera).
#include <gtest/gtest.h>

#include "pxr/base/gf/frustum.h"
#include "pxr/base/gf/rotation.h"
#include "testenv/unit/delegate/test_host.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

/// A unit square at the origin, ten units away, with the axis of view off the middle of the picture: at its
/// distance the picture spans [-0.5, 2.5] x [-1, 2].
struct Matrices : testing::Test {
    Matrices() : host({"primId", "cameraDepth"}, 1) {
        host.scene().addDome(SdfPath("/dome"));
        host.scene().addSquare(SdfPath("/square"), GfVec3f(0.5f));
        frustum.SetProjectionType(GfFrustum::Perspective);
        frustum.SetWindow(GfRange2d(GfVec2d(-0.05, -0.1), GfVec2d(0.25, 0.2)));
        frustum.SetNearFar(GfRange1d(1, 100));
        frustum.SetPosition(GfVec3d(0, 0, 10));
    }
    void look() {
        host.setMatrices(frustum.ComputeViewMatrix(), frustum.ComputeProjectionMatrix());
        ASSERT_TRUE(host.render());
    }
    /// Whether the square is seen where the picture shows (x, y) of the plane z = 0, for the camera as it
    /// begins.
    bool seenAt(double x, double y) { return host.readInt("primId", (x - 1) / 3, (y - 0.5) / 3) >= 0; }

    TestHost host;
    GfFrustum frustum;
};

TEST_F(Matrices, ofAPerspectiveOffTheAxis) {
    look();
    for (double x : {-0.4, 0.0, 0.4}) {
        EXPECT_TRUE(seenAt(x, -0.4)) << x;
        EXPECT_TRUE(seenAt(x, 0.4)) << x;
    }
    for (double y : {-0.7, 0.6, 1.5}) {
        EXPECT_FALSE(seenAt(0, y)) << y;
    }
    EXPECT_FALSE(seenAt(0.6, 0));
    const float* depths = static_cast<const float*>(host.buffer("cameraDepth").Map());
    EXPECT_NEAR(depths[TestHost::width * (TestHost::height / 3) + TestHost::width / 6], 10.f, 1e-3f);
    host.buffer("cameraDepth").Unmap();
}

TEST_F(Matrices, thatChangeRestartThePicture) {
    look();
    EXPECT_TRUE(seenAt(0, 0));
    frustum.SetPosition(GfVec3d(-1, -1, 10));
    look();
    EXPECT_FALSE(seenAt(0, 0));
    EXPECT_TRUE(seenAt(1, 1));
    frustum.SetRotation(GfRotation(GfVec3d(0, 1, 0), 180)); // turns its back
    look();
    EXPECT_FALSE(seenAt(1, 1));
    EXPECT_TRUE(host.pass().IsConverged());
}

} // namespace
