#include "renderer/shading/albedo.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/material.h"

namespace hipr {

namespace {

constexpr double Pi = 3.14159265358979323846;

double lambda(const glm::dvec3& w, double alpha) {
    return 0.5 * std::sqrt(1.0 + alpha * alpha * (w.x * w.x + w.y * w.y) / (w.z * w.z)) - 0.5;
}

/// Visible normals, as sampleVisibleNormal() in microfacet.glsl.
glm::dvec3 visibleNormal(const glm::dvec3& w, double alpha, double u, double v) {
    const glm::dvec3 stretched = glm::normalize(glm::dvec3(alpha * w.x, alpha * w.y, w.z));
    const double phi = Pi * u; // the lobe is symmetric: half a turn will do
    const double z = (1.0 - v) * (1.0 + stretched.z) - stretched.z;
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z));
    const glm::dvec3 h = glm::dvec3(r * std::cos(phi), r * std::sin(phi), z) + stretched;
    return glm::normalize(glm::dvec3(alpha * h.x, alpha * h.y, std::max(h.z, 1e-12)));
}

} // namespace

glm::vec2 specularAlbedo(double cosine, double alpha, int steps) {
    cosine = std::max(cosine, 1e-4);
    const glm::dvec3 o(std::sqrt(1.0 - cosine * cosine), 0.0, cosine);
    const double lambdaO = lambda(o, alpha);
    glm::dvec2 sum(0.0);
    const int turns = steps / 2;
    for (int i = 0; i < turns; ++i)
        for (int j = 0; j < steps; ++j) {
            const glm::dvec3 h = visibleNormal(o, alpha, (i + 0.5) / turns, (j + 0.5) / steps);
            const double c = glm::dot(o, h);
            const glm::dvec3 in = 2.0 * c * h - o;
            if (in.z <= 0.0) continue;
            const double weight = (1.0 + lambdaO) / (1.0 + lambdaO + lambda(in, alpha));
            const double schlick = std::pow(std::clamp(1.0 - c, 0.0, 1.0), 5.0);
            sum += weight * glm::dvec2(1.0 - schlick, schlick);
        }
    return glm::vec2(sum / double(turns * steps));
}

const std::vector<glm::vec2>& specularAlbedoTable() {
    static const std::vector<glm::vec2> table = [] {
        constexpr int Steps = 40;
        constexpr uint32_t Cosines = gpu::ALBEDO_COSINES, Roughnesses = gpu::ALBEDO_ROUGHNESSES;
        std::vector<glm::vec2> values;
        for (uint32_t j = 0; j < Roughnesses; ++j) {
            const double roughness = double(j) / (Roughnesses - 1);
            const double alpha = std::max(roughness * roughness, 2e-4); // MIN_ALPHA
            glm::dvec2 mean(0.0);
            for (uint32_t i = 0; i < Cosines; ++i) {
                const double x = double(i) / (Cosines - 1);
                const glm::vec2 value = specularAlbedo(x * x, alpha, Steps);
                values.push_back(value);
                // Mean = integral of 2 c E(c) dc with c = x^2, by the trapezoidal rule in x.
                mean += glm::dvec2(value) * (4.0 * x * x * x) * (i + 1 == Cosines ? 0.5 : 1.0) /
                        double(Cosines - 1);
            }
            values.push_back(glm::vec2(mean));
        }
        return values;
    }();
    return table;
}

} // namespace hipr
