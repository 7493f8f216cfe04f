#include "renderer/shading/media.h"

#include <algorithm>

namespace hipr {

namespace {

/// The phase function is a needle beyond these.
float usableAnisotropy(float anisotropy) {
    return std::clamp(anisotropy, -0.99f, 0.99f);
}

} // namespace

void setTransmissionMedium(gpu::MediumRecord& medium, const glm::vec3& color, float depth,
                           const glm::vec3& scatter, float anisotropy) {
    const glm::vec3 scattering = scatter / depth;
    glm::vec3 absorption = -glm::log(glm::max(color, glm::vec3(1e-4f))) / depth - scattering;
    const float least = std::min(absorption.x, std::min(absorption.y, absorption.z));
    if (least < 0.f) absorption -= least; // by grey, so that none is negative
    medium.extinction = absorption + scattering;
    for (int c = 0; c < 3; ++c)
        medium.albedo[c] = medium.extinction[c] > 0.f ? scattering[c] / medium.extinction[c] : 0.f;
    medium.anisotropy = usableAnisotropy(anisotropy);
}

gpu::MediumRecord subsurfaceMedium(float radius, const glm::vec3& scale, float anisotropy) {
    gpu::MediumRecord medium{};
    if (radius <= 0.f) return medium;
    medium.extinction = 1.f / (radius * glm::max(scale, glm::vec3(0.01f)));
    medium.albedo = glm::vec3(1.f);
    medium.anisotropy = usableAnisotropy(anisotropy);
    return medium;
}

float abbeNumber(float scale, float number) {
    return scale > 0.f ? std::max(number, 1.f) / scale : 0.f;
}

} // namespace hipr
