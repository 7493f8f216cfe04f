#include "renderer/splats/tidy.h"

#include <algorithm>
#include <cmath>

#include "renderer/splats/arrays.h"

namespace hipr {
namespace {

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The arrays of a cloud, splat by splat.
class Rows {
public:
    explicit Rows(SplatCloud& cloud) : _cloud(cloud), _coefficients(shCoefficients(cloud.shDegree)) {}

    bool usable(size_t i) const {
        if (!finite(_cloud.positions[i])) return false;
        if (!_cloud.scales.empty() && !finite(_cloud.scales[i])) return false;
        if (!_cloud.opacities.empty() && !std::isfinite(_cloud.opacities[i])) return false;
        if (!_cloud.orientations.empty()) {
            const float length = glm::length(_cloud.orientations[i]);
            if (!std::isfinite(length) || length < 1e-20f) return false;
        }
        if (_cloud.coefficients.empty()) return true;
        const auto first = _cloud.coefficients.begin() + ptrdiff_t(i * _coefficients);
        return std::all_of(first, first + _coefficients, finite);
    }

    void move(size_t from, size_t to) {
        if (from == to) return;
        _cloud.positions[to] = _cloud.positions[from];
        if (!_cloud.orientations.empty()) _cloud.orientations[to] = _cloud.orientations[from];
        if (!_cloud.scales.empty()) _cloud.scales[to] = _cloud.scales[from];
        if (!_cloud.opacities.empty()) _cloud.opacities[to] = _cloud.opacities[from];
        if (!_cloud.coefficients.empty())
            std::copy_n(_cloud.coefficients.begin() + ptrdiff_t(from * _coefficients), _coefficients,
                        _cloud.coefficients.begin() + ptrdiff_t(to * _coefficients));
    }

    void resize(size_t count) {
        forEachArray(_cloud, count, [](auto& array, size_t length) {
            if (!array.empty()) array.resize(length);
        });
    }

private:
    SplatCloud& _cloud;
    uint32_t _coefficients;
};

size_t clampOpacities(std::vector<float>& opacities) {
    size_t outside = 0;
    for (float& opacity : opacities) {
        const float inside = std::clamp(opacity, 0.f, 1.f);
        outside += inside != opacity;
        opacity = inside;
    }
    return outside;
}

} // namespace

void tidySplats(SplatCloud& cloud, const MessageSink& messages) {
    const size_t all = cloud.size();
    Rows rows(cloud);
    size_t kept = 0;
    for (size_t i = 0; i < all; ++i)
        if (rows.usable(i)) rows.move(i, kept++);
    rows.resize(kept);
    for (glm::quat& orientation : cloud.orientations)
        orientation = glm::normalize(orientation);
    for (glm::vec3& scale : cloud.scales)
        scale = glm::abs(scale);
    const size_t outside = clampOpacities(cloud.opacities);

    const auto warn = [&](size_t count, const char* what) {
        if (count > 0 && messages)
            messages(Severity::Warning, cloud.name,
                     std::to_string(count) + " of " + std::to_string(all) + " splats " + what);
    };
    warn(all - kept, "hold numbers that are not finite, or no orientation, and are left out");
    warn(outside, "have an opacity outside 0..1, which is clamped");
}

} // namespace hipr
