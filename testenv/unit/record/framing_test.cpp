#include "plugin/record/framing.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "pxr/base/gf/frustum.h"
#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/range3d.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {
namespace {

std::vector<GfVec3d> corners(const GfRange3d& box) {
    std::vector<GfVec3d> points;
    for (size_t i = 0; i < 8; ++i)
        points.push_back(box.GetCorner(i));
    return points;
}

/// Extent of the points in the picture, -1 to 1 in each direction; also checks that nothing is clipped.
GfRange3d projected(const GfCamera& camera, const std::vector<GfVec3d>& points) {
    const GfFrustum frustum = camera.GetFrustum();
    const GfMatrix4d toNdc = frustum.ComputeViewMatrix() * frustum.ComputeProjectionMatrix();
    GfRange3d box;
    for (const GfVec3d& point : points)
        box.UnionWith(toNdc.Transform(point));
    return box;
}

void expectTight(const GfCamera& camera, const std::vector<GfVec3d>& points) {
    const GfRange3d box = projected(camera, points);
    for (int i = 0; i < 2; ++i) {
        EXPECT_GE(box.GetMin()[i], -1.0 / 1.05 - 1e-6);
        EXPECT_LE(box.GetMax()[i], 1.0 / 1.05 + 1e-6);
        EXPECT_NEAR(box.GetMin()[i], -box.GetMax()[i], 1e-6) << "centred";
    }
    EXPECT_NEAR(std::max(box.GetMax()[0], box.GetMax()[1]), 1.0 / 1.05, 1e-6) << "as close as possible";
    EXPECT_GT(box.GetMin()[2], -1.0);
    EXPECT_LT(box.GetMax()[2], 1.0);
}

TEST(Framing, FillsThePictureAtAnyShapeAndAspect) {
    const GfRange3d boxes[] = {{GfVec3d(-1), GfVec3d(1)},
                               {GfVec3d(100, 200, -50), GfVec3d(101, 260, -49)},
                               {GfVec3d(-1e6, 0, -1e6), GfVec3d(1e6, 1, 1e6)},
                               {GfVec3d(0), GfVec3d(1e-4, 2e-4, 1e-4)}};
    for (const GfRange3d& box : boxes)
        for (const double aspect : {0.5, 1.0, 16.0 / 9.0, 4.0})
            for (const UpAxis up : {UpAxis::Y, UpAxis::Z})
                expectTight(framePoints(corners(box), up, aspect), corners(box));
}

TEST(Framing, LooksFromTheFrontRightAboveWithUpUpright) {
    const GfCamera y = framePoints(corners({GfVec3d(-1), GfVec3d(1)}), UpAxis::Y, 1.0);
    const GfVec3d eyeY = y.GetTransform().ExtractTranslation();
    EXPECT_GT(eyeY[0], 0.0);
    EXPECT_GT(eyeY[1], 0.0);
    EXPECT_GT(eyeY[2], eyeY[0]);
    EXPECT_GT(y.GetTransform().TransformDir(GfVec3d::YAxis())[1], 0.9);

    const GfCamera z = framePoints(corners({GfVec3d(-1), GfVec3d(1)}), UpAxis::Z, 1.0);
    const GfVec3d eyeZ = z.GetTransform().ExtractTranslation();
    EXPECT_GT(eyeZ[0], 0.0);
    EXPECT_GT(eyeZ[2], 0.0);
    EXPECT_LT(eyeZ[1], -eyeZ[0]);
    EXPECT_GT(z.GetTransform().TransformDir(GfVec3d::YAxis())[2], 0.9);
}

TEST(Framing, NothingOrASinglePointIsFramedAsAUnitCube) {
    const GfVec3d spot(5, 6, 7);
    expectTight(framePoints({}, UpAxis::Y, 1.5), corners({GfVec3d(-0.5), GfVec3d(0.5)}));
    expectTight(framePoints({spot, spot}, UpAxis::Y, 1.5),
                corners({spot - GfVec3d(0.5), spot + GfVec3d(0.5)}));
}

TEST(Framing, FlatThingSeenEdgeOnKeepsItsDistance) {
    // A segment along the view axis has no width in the picture.
    const GfCamera reference = framePoints({}, UpAxis::Y, 1.0);
    const GfVec3d forward = reference.GetTransform().TransformDir(GfVec3d(0, 0, -1));
    const GfCamera camera = framePoints({GfVec3d(0), forward * 10.0}, UpAxis::Y, 1.0);
    const GfVec3d eye = camera.GetTransform().ExtractTranslation();
    EXPECT_NEAR(eye.GetLength(), 1.0, 1e-6);
    EXPECT_GT(camera.GetClippingRange().GetMin(), 0.f);
}

} // namespace
} // namespace hipr::record
