/// @file ggx.h
/// The GGX microfacet distribution on the host, as shaders/material/microfacet.glsl has it (isotropic).
#pragma once

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace hipr::ggx {

constexpr double Pi = 3.14159265358979323846;
constexpr double MinAlpha = 2e-4; ///< MIN_ALPHA

inline double alphaOf(double roughness) {
    return std::max(roughness * roughness, MinAlpha);
}

inline double lambda(const glm::dvec3& w, double alpha) {
    return 0.5 * std::sqrt(1.0 + alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z)) - 0.5;
}

/// Visible normals, as sampleVisibleNormal().
inline glm::dvec3 visibleNormal(const glm::dvec3& w, double alpha, double u, double v) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * w.x, alpha * w.y, w.z));
    const double phi = Pi * u; // the lobe is symmetric: half a turn will do
    const double z = (1.0 - v) * (1.0 + stretched.z) - stretched.z;
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    const glm::dvec3 h = glm::dvec3(r * std::cos(phi), r * std::sin(phi), z) + stretched;
    return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-12)));
}

/// The direction of a viewer in the xz plane.
inline glm::dvec3 viewer(double cosine) {
    cosine = std::max(cosine, 1e-4);
    return {std::sqrt(1.0 - cosine * cosine), 0.0, cosine};
}

/// The part of light from `o` that a single-scattering lobe returns, by quadrature over its visible normals:
/// the mean of `weight(h)` at steps^2 / 2 of them.
template <class Value, class Weight>
Value integrate(const glm::dvec3& o, double alpha, int steps, const Weight& weight) {
    Value sum(0.0);
    const int turns = steps / 2;
    for (int i = 0; i < turns; ++i)
        for (int j = 0; j < steps; ++j)
            sum += weight(visibleNormal(o, alpha, (i + 0.5) / turns, (j + 0.5) / steps));
    return sum / double(turns * steps);
}

} // namespace hipr::ggx
