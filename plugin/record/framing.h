/// @file framing.h
/// Automatic framing of a scene: a camera that shows a set of points.
#pragma once

#include <vector>

#include "pxr/base/gf/camera.h"
#include "pxr/base/gf/vec3d.h"
#include "pxr/pxr.h"

namespace hipr::record {

enum class UpAxis { Y, Z };

/// A perspective camera (36 mm film width, 50 mm lens) that looks at `points` from the front, a little from
/// the right and from above, and stands as close as possible with all of them inside the picture and 5 % of
/// air around them. The front is +Z where Y is up and -Y where Z is up. Clipping encloses the points.
/// `aspect` is width over height. Points without extent are framed as a cube of size 1 around them, no points
/// as one around the origin.
PXR_NS::GfCamera framePoints(std::vector<PXR_NS::GfVec3d> points, UpAxis up, double aspect);

} // namespace hipr::record
