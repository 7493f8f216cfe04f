/// @file oracle.h
/// Splats blended front to back in double precision, pixel by pixel, with none of the renderer's formulas:
/// full covariance matrices, their inverses, spherical harmonics from Legendre polynomials.
#pragma once

#include "renderer/higs/splat_pass.h"
#include "renderer/scene/camera.h"

namespace hipr::test {

/// What to draw, as people would say it.
struct SplatScene {
    std::vector<SplatCloud> clouds;
    std::vector<glm::dmat4> transforms; ///< by cloud; missing ones are the identity
    CameraDesc camera;
    uint32_t width = 128, height = 96;
    bool antialiased = false;
    bool exactTangents = false; ///< tangential splats pixel by pixel, without dilation
    std::vector<float> limits;  ///< camera depths of what is opaque; empty: nothing is

    glm::dmat4 transform(size_t cloud) const {
        return cloud < transforms.size() ? transforms[cloud] : glm::dmat4(1.0);
    }
};

struct OraclePixel {
    glm::dvec3 color{0};
    double transmittance = 1;
    double depth = 0; ///< of the splat at which it falls below 1/2; 0: none
    int cloud = -1;   ///< the splat's
    uint32_t splat = gpu::NO_SPLAT;
    bool certain = true; ///< that a little rounding would give the same splat
    double flips = 0;    ///< what splats that just reach 1/255, or just do not, may change
};

/// `tile`: of the lists, which are sorted each by itself; `boxes`: of tiles of that size a splat only shows
/// in those that meet a square of 3 standard deviations (along the ellipse's longer axis) around it.
std::vector<OraclePixel> oraclePicture(const SplatScene& scene, glm::uvec2 tile, bool boxes = false);

/// How many (splat, tile) there are: ellipses of alpha = 1/255, or squares, against closed tiles.
size_t oraclePairs(const SplatScene& scene, glm::uvec2 tile, bool boxes = false);

} // namespace hipr::test
