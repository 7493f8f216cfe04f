/// @file camera.h
/// What a picture is taken with: a view, a lens, an exposure.
#pragma once

#include <vector>

#include "renderer/api/cull.h"
#include "renderer/api/motion.h"
#include "renderer/api/types.h"

namespace hipr {

/// Where a lens is sharp, and how much it blurs elsewhere (thin lens).
struct Lens {
    /// Of the aperture, in world units: focal length / (2 fStop). 0: a pinhole, all is sharp.
    double radius = 0.0;
    /// Along the view axis, in world units. Not above 0: a pinhole.
    double focusDistance = 0.0;
    /// Corners of the aperture's polygon; below 3: a disk.
    int blades = 0;
    /// Degrees counter-clockwise as the camera sees it; 0: a corner to the right.
    float bladeRotation = 0.f;
    bool operator==(const Lens& o) const {
        return radius == o.radius && focusDistance == o.focusDistance && blades == o.blades &&
               bladeRotation == o.bladeRotation;
    }
};

constexpr size_t MaxClipPlanes = 8;

/// A view as matrices, so that any host camera fits. Perspective and orthographic are told apart by the
/// matrix.
struct CameraDesc {
    glm::dmat4 worldToView{1.0}; ///< right-handed, looks along -Z
    glm::dmat4 projection{1.0};  ///< OpenGL clip space (-w <= z <= w); already fitted to the film's aspect
    Lens lens{};                 ///< perspective only
    /// Planes (a, b, c, d) in view space; the camera sees no point with a x + b y + c z + d < 0. What is cut
    /// off still casts light and shadow. Those beyond MaxClipPlanes are ignored.
    std::vector<glm::dvec4> clipPlanes{};
    CullStyle cull = CullStyle::Nothing; ///< of objects that have none of their own
    Shutter shutter{};
    /// By rising time; below two the camera stands still. What first-hit AOVs show is seen from worldToView.
    std::vector<CameraKey> motion{};
    float exposure = 1.f; ///< factor on the AOV color; no sample depends on it

    /// Whether samples taken with one are samples of the other.
    bool sameSamples(const CameraDesc& o) const {
        return sameView(o) && lens == o.lens && clipPlanes == o.clipPlanes && cull == o.cull &&
               shutter == o.shutter && motion == o.motion;
    }
    /// Whether both look at the same from the same place.
    bool sameView(const CameraDesc& o) const {
        return worldToView == o.worldToView && projection == o.projection;
    }
    bool operator==(const CameraDesc& o) const { return sameSamples(o) && exposure == o.exposure; }
};

} // namespace hipr
