#include "renderer/shading/albedo.h"

#include <algorithm>
#include <cmath>

#include "renderer/shading/ggx.h"
#include "shaders/shared/hemisphere.h"
#include "shaders/shared/material.h"

namespace hipr {

glm::vec2 specularAlbedo(double cosine, double alpha, int steps) {
    const glm::dvec3 o = ggx::viewer(cosine);
    const double lambdaO = ggx::lambda(o, alpha);
    return ggx::integrate<glm::dvec2>(o, alpha, steps, [&](const glm::dvec3& h) {
        const double c = glm::dot(o, h);
        const glm::dvec3 in = 2.0 * c * h - o;
        if (in.z <= 0.0) return glm::dvec2(0.0);
        const double weight = (1.0 + lambdaO) / (1.0 + lambdaO + ggx::lambda(in, alpha));
        const double schlick = std::pow(std::clamp(1.0 - c, 0.0, 1.0), 5.0);
        return weight * glm::dvec2(1.0 - schlick, schlick);
    });
}

const std::vector<glm::vec2>& specularAlbedoTable() {
    static const std::vector<glm::vec2> table = [] {
        constexpr int Steps = 40;
        constexpr uint32_t Cosines = gpu::ALBEDO_COSINES, Roughnesses = gpu::ALBEDO_ROUGHNESSES;
        std::vector<glm::vec2> values;
        for (uint32_t j = 0; j < Roughnesses; ++j) {
            const double roughness = double(j) / (Roughnesses - 1);
            const double alpha = ggx::alphaOf(roughness);
            glm::dvec2 mean(0.0);
            for (uint32_t i = 0; i < Cosines; ++i) {
                const double x = double(i) / (Cosines - 1);
                const glm::vec2 value = specularAlbedo(x * x, alpha, Steps);
                values.push_back(value);
                mean += glm::dvec2(value) * double(gpu::hemisphereShare(i, Cosines));
            }
            values.push_back(glm::vec2(mean));
        }
        return values;
    }();
    return table;
}

} // namespace hipr
