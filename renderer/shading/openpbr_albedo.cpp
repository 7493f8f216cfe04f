#include "renderer/shading/openpbr_albedo.h"

#include <tbb/parallel_for.h>

#include "renderer/shading/ggx.h"
#include "shaders/shared/fuzz.h"
#include "shaders/shared/hemisphere.h"
#include "shaders/shared/material.h"

namespace hipr {

namespace {

/// Unpolarised reflectance of an interface, as dielectricFresnel() in microfacet.glsl.
double fresnel(double cosine, double eta) {
    const double squared = eta * eta - 1.0 + cosine * cosine;
    if (squared <= 0.0) return 1.0;
    const double g = std::sqrt(squared);
    const double a = (g - cosine) / (g + cosine);
    const double b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

/// How much of the light refracted by a microfacet leaves the surface.
double refracted(const glm::dvec3& o, const glm::dvec3& h, double cosine, double alpha, double eta) {
    const double inverse = 1.0 / eta;
    const double cosT = std::sqrt(std::max(0.0, 1.0 - inverse * inverse * (1.0 - cosine * cosine)));
    const glm::dvec3 in = glm::normalize((inverse * cosine - cosT) * h - inverse * o);
    return in.z < 0.0 ? 1.0 / (1.0 + ggx::lambda(in, alpha)) : 0.0;
}

/// One row: values at all cosines, then their mean.
void fillRow(glm::vec2* row, double eta, double alpha) {
    constexpr int Quadrature = 36;
    constexpr uint32_t Cosines = gpu::INTERFACE_COSINES;
    glm::dvec2 mean(0.0);
    for (uint32_t i = 0; i < Cosines; ++i) {
        const double root = double(i) / (Cosines - 1);
        row[i] = interfaceAlbedo(root * root, alpha, eta, Quadrature);
        mean += glm::dvec2(row[i]) * double(gpu::hemisphereShare(i, Cosines));
    }
    row[Cosines] = glm::vec2(mean);
}

std::vector<glm::vec2> interfaceTable() {
    constexpr uint32_t Width = gpu::INTERFACE_COSINES + 1, Rows = gpu::INTERFACE_ROUGHNESSES;
    std::vector<glm::vec2> values(2 * gpu::INTERFACE_STEPS * Rows * Width);
    tbb::parallel_for(0u, 2 * gpu::INTERFACE_STEPS * Rows, [&](uint32_t at) {
        const uint32_t k = at / Rows % gpu::INTERFACE_STEPS;
        const bool outside = at < gpu::INTERFACE_STEPS * Rows;
        const double step = double(k) / (gpu::INTERFACE_STEPS - 1), x = gpu::INTERFACE_MOST * step * step;
        const double eta = (1.0 + x) / (1.0 - x), roughness = double(at % Rows) / (Rows - 1);
        fillRow(&values[at * Width], outside ? eta : 1.0 / eta, ggx::alphaOf(roughness));
    });
    return values;
}

void appendFuzz(std::vector<float>& out) {
    for (uint32_t j = 0; j < gpu::FUZZ_ROUGHNESSES; ++j)
        for (uint32_t i = 0; i < gpu::FUZZ_COSINES; ++i) {
            const double root = double(i) / (gpu::FUZZ_COSINES - 1);
            const double roughness = gpu::FUZZ_LEAST_ROUGHNESS +
                                     (1.0 - gpu::FUZZ_LEAST_ROUGHNESS) * j / (gpu::FUZZ_ROUGHNESSES - 1);
            out.push_back(fuzzAlbedo(root * root, roughness, 64));
        }
}

} // namespace

glm::vec2 interfaceAlbedo(double cosine, double alpha, double eta, int steps) {
    const glm::dvec3 o = ggx::viewer(cosine);
    const double lambdaO = ggx::lambda(o, alpha);
    const bool nothing = eta == 1.0;
    return ggx::integrate<glm::dvec2>(o, alpha, steps, [&](const glm::dvec3& h) {
        const double c = glm::dot(o, h), reflectance = nothing ? 0.0 : fresnel(c, eta);
        const glm::dvec3 in = 2.0 * c * h - o;
        double back = 0.0;
        if (in.z > 0.0) back = reflectance * (1.0 + lambdaO) / (1.0 + lambdaO + ggx::lambda(in, alpha));
        const double through = reflectance < 1.0 ? (1.0 - reflectance) * refracted(o, h, c, alpha, eta) : 0.0;
        return glm::dvec2(back, back + through);
    });
}

float fuzzAlbedo(double cosine, double roughness, int steps) {
    const glm::vec3 o(ggx::viewer(cosine));
    double sum = 0.0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = (i + 0.5) / steps, phi = ggx::Pi * (j + 0.5) / steps; // half a turn will do
            const double sine = std::sqrt(1.0 - z * z);
            sum += gpu::fuzzReflection(o, glm::vec3(sine * std::cos(phi), sine * std::sin(phi), z),
                                       float(roughness));
        }
    return float(sum * 2.0 * ggx::Pi / (steps * steps));
}

const std::vector<float>& openPbrAlbedoTable() {
    static const std::vector<float> table = [] {
        std::vector<float> values;
        for (const glm::vec2& value : interfaceTable())
            values.insert(values.end(), {value.x, value.y});
        appendFuzz(values);
        return values;
    }();
    return table;
}

} // namespace hipr
