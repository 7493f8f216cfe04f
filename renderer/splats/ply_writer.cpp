#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <ostream>

#include "renderer/splats/splat_file.h"

namespace hipr {
namespace {

constexpr glm::vec3 zero{0.f};

float logit(float opacity) {
    // Logits that are opacities of 0 and 1 again in single precision.
    constexpr float least = -110.f, most = 20.f;
    return std::clamp(std::log(opacity / (1.f - opacity)), least, most);
}

float logScale(float scale) {
    return std::log(std::max(scale, std::numeric_limits<float>::min()));
}

void writeHeader(const SplatCloud& cloud, std::ostream& out) {
    out << "ply\nformat binary_little_endian 1.0\nelement vertex " << cloud.size() << '\n';
    const auto property = [&](const std::string& name) { out << "property float " << name << '\n'; };
    const auto numbered = [&](const char* name, uint32_t count) {
        for (uint32_t i = 0; i < count; ++i)
            property(name + std::to_string(i));
    };
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"})
        property(name);
    numbered("f_dc_", 3);
    numbered("f_rest_", 3 * (shCoefficients(cloud.shDegree) - 1));
    property("opacity");
    numbered("scale_", 3);
    numbered("rot_", 4);
    out << "end_header\n";
}

void put(std::ostream& out, float value) {
    uint32_t bits;
    static_assert(sizeof(bits) == sizeof(value));
    std::memcpy(&bits, &value, sizeof(bits));
    for (int shift = 0; shift < 32; shift += 8)
        out.put(char(bits >> shift & 0xff));
}

void put(std::ostream& out, const glm::vec3& v) {
    put(out, v.x);
    put(out, v.y);
    put(out, v.z);
}

} // namespace

void writePly(const SplatCloud& cloud, std::ostream& out) {
    writeHeader(cloud, out);
    const uint32_t coefficients = shCoefficients(cloud.shDegree);
    const std::vector<glm::vec3> black(coefficients, zero); // 0.5 once it is shifted
    for (size_t i = 0; i < cloud.size(); ++i) {
        const glm::vec3* sh =
            cloud.coefficients.empty() ? black.data() : &cloud.coefficients[i * coefficients];
        const glm::vec3 scale = cloud.scales.empty() ? glm::vec3(1.f) : cloud.scales[i];
        const glm::quat turn =
            cloud.orientations.empty() ? glm::quat(1.f, 0.f, 0.f, 0.f) : cloud.orientations[i];
        put(out, cloud.positions[i]);
        put(out, zero);
        put(out, sh[0]);
        for (int channel = 0; channel < 3; ++channel)
            for (uint32_t k = 1; k < coefficients; ++k)
                put(out, sh[k][channel]);
        put(out, logit(cloud.opacities.empty() ? 1.f : cloud.opacities[i]));
        put(out, {logScale(scale.x), logScale(scale.y), logScale(scale.z)});
        for (const float part : {turn.w, turn.x, turn.y, turn.z})
            put(out, part);
    }
}

} // namespace hipr
