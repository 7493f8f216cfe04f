#include "plugin/record/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/range3d.h"
#include "pxr/base/gf/rotation.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

constexpr double filmWidth = 36.0, focalLength = 50.0; // mm
constexpr double azimuth = 30.0, elevation = 20.0;     // degrees, from the front
constexpr double air = 1.05;
constexpr double lowest = std::numeric_limits<double>::lowest();

/// Camera-to-world rotation of the viewpoint; a camera looks down its -Z with +Y up.
GfMatrix4d viewpoint(UpAxis up) {
    GfMatrix4d rotation = GfMatrix4d(GfRotation(GfVec3d::XAxis(), -elevation), GfVec3d(0)) *
                          GfMatrix4d(GfRotation(GfVec3d::YAxis(), azimuth), GfVec3d(0));
    if (up == UpAxis::Z) rotation *= GfMatrix4d(GfRotation(GfVec3d::XAxis(), 90.0), GfVec3d(0));
    return rotation;
}

/// Adds the corners of a unit cube to points that have no extent.
void ensureExtent(std::vector<GfVec3d>& points) {
    GfRange3d box;
    for (const GfVec3d& point : points)
        box.UnionWith(point);
    if (box.IsEmpty()) box.UnionWith(GfVec3d(0.0));
    const double magnitude = std::max(box.GetMin().GetLength(), box.GetMax().GetLength());
    if (box.GetSize().GetLength() > 1e-9 * std::max(magnitude, 1e-20)) return;
    const GfVec3d middle = box.GetMidpoint();
    const GfRange3d cube(middle - GfVec3d(0.5), middle + GfVec3d(0.5));
    for (size_t i = 0; i < 8; ++i)
        points.push_back(cube.GetCorner(i));
}

/// How far back an eye must be so that all points fit in one direction of the picture. A point (s, z) in view
/// axes is inside for an eye at (s0, z0) when |s - s0| <= slope (z0 - z), that is, when s0 + slope z0 >= s +
/// slope z and -s0 + slope z0 >= -s + slope z: the sum of both bounds gives z0.
double fittingDepth(const std::vector<GfVec3d>& points, int axis, double slope) {
    double upper = lowest, lower = lowest;
    for (const GfVec3d& point : points) {
        upper = std::max(upper, point[axis] + slope * point[2]);
        lower = std::max(lower, -point[axis] + slope * point[2]);
    }
    return 0.5 * (upper + lower) / slope;
}

/// Where an eye at a depth must be so that the points reach equally far to both sides, by bisection: moving
/// the eye one way moves every point the other way.
double centringSide(const std::vector<GfVec3d>& points, int axis, double depth, const GfRange3d& box) {
    double low = box.GetMin()[axis], high = box.GetMax()[axis];
    for (int i = 0; i < 48; ++i) {
        const double side = 0.5 * (low + high);
        double first = -lowest, last = lowest;
        for (const GfVec3d& point : points) {
            const double projected = (point[axis] - side) / (depth - point[2]);
            first = std::min(first, projected);
            last = std::max(last, projected);
        }
        (first + last > 0.0 ? low : high) = side;
    }
    return 0.5 * (low + high);
}

} // namespace

GfCamera framePoints(std::vector<GfVec3d> points, UpAxis up, double aspect) {
    ensureExtent(points);
    const GfMatrix4d rotation = viewpoint(up);
    const GfMatrix4d toView = rotation.GetTranspose();
    GfRange3d box; // in view axes
    for (GfVec3d& point : points) {
        point = toView.TransformDir(point);
        box.UnionWith(point);
    }
    const double nearest = box.GetMax()[2], farthest = box.GetMin()[2];
    const double slope = 0.5 * filmWidth / focalLength / air;
    // A flat thing seen edge-on could touch the eye: stay some of its depth away.
    const double depth = std::max({fittingDepth(points, 0, slope), fittingDepth(points, 1, slope / aspect),
                                   nearest + 0.1 * (nearest - farthest)});
    const GfVec3d eye(centringSide(points, 0, depth, box), centringSide(points, 1, depth, box), depth);

    GfMatrix4d placement = rotation;
    placement.SetTranslateOnly(rotation.TransformDir(eye));
    GfCamera camera(placement, GfCamera::Perspective, float(filmWidth), float(filmWidth / aspect));
    camera.SetFocalLength(float(focalLength));
    camera.SetClippingRange(GfRange1f(float(0.5 * (depth - nearest)), float(2.0 * (depth - farthest))));
    return camera;
}

} // namespace hipr::record
