/// @file splats.h
/// Clouds of 3D Gaussians ("splats"), as captures and OpenUSD's ParticleField3DGaussianSplat hold them.
///
/// A splat is the density exp(-x^T x / 2) in the space that its scales, its orientation and its position
/// span, times its opacity. Its colour towards a viewer is max(sum over k of Y_k(d) c_k + 0.5, 0): real
/// spherical harmonics Y_k of the direction d from the camera to the splat, in object space (Kerbl et al.,
/// "3D Gaussian Splatting for Real-Time Radiance Field Rendering", 2023). Everything is as activated: no
/// logarithms of scales, no logits.
#pragma once

#include <memory>

#include <glm/gtc/quaternion.hpp>

#include "renderer/api/types.h"

namespace hipr {

/// By what splats are ordered front to back.
enum class SplatSorting : uint32_t { ZDepth, CameraDistance, RayHitDistance };
/// How a splat becomes an ellipse on the film: by the camera's projection linearised at its centre, or by the
/// plane tangential to the sphere around the camera.
enum class SplatProjection : uint32_t { Perspective, Tangential };

/// Coefficients of each colour channel: 1, 4, 9, 16 for degrees 0 to 3.
constexpr uint32_t shCoefficients(uint32_t degree) {
    return (degree + 1) * (degree + 1);
}

struct SplatCloud {
    std::string name;                    ///< used in messages; the prim path in a Hydra host
    std::vector<glm::vec3> positions;    ///< object space; as many as there are splats
    std::vector<glm::quat> orientations; ///< as many, of unit length; empty: none is turned
    std::vector<glm::vec3> scales;       ///< as many, standard deviations along the axes; empty: all 1
    std::vector<float> opacities;        ///< as many, 0..1; empty: all 1
    uint32_t shDegree = 0;               ///< 0..3
    std::vector<glm::vec3>
        coefficients; ///< shCoefficients(shDegree) a splat, splat by splat; empty: colour 0.5
    SplatSorting sorting = SplatSorting::ZDepth;
    SplatProjection projection = SplatProjection::Perspective;

    size_t size() const { return positions.size(); }
};

} // namespace hipr
