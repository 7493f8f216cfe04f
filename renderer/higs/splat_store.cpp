#include "renderer/higs/splat_store.h"

#include <atomic>
#include <cmath>
#include <mutex>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/quaternion.hpp>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace hipr {
namespace {

constexpr float HalfMaximum = 65504.f;

bool finite(const glm::vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The cloud's arrays with their defaults, splat by splat.
class Splats {
public:
    explicit Splats(const SplatCloud& cloud)
        : _cloud(cloud), _orientations(full(cloud.orientations, 1)), _scales(full(cloud.scales, 1)),
          _opacities(full(cloud.opacities, 1)), _coefficients(full(cloud.coefficients, coefficientCount())) {}

    uint32_t degree() const { return _coefficients ? std::min(_cloud.shDegree, 3u) : 0; }
    uint32_t coefficientCount() const { return shCoefficients(std::min(_cloud.shDegree, 3u)); }

    glm::vec3 position(size_t i) const { return _cloud.positions[i]; }
    glm::quat orientation(size_t i) const {
        return _orientations ? _cloud.orientations[i] : glm::quat(1, 0, 0, 0);
    }
    glm::vec3 scale(size_t i) const { return _scales ? _cloud.scales[i] : glm::vec3(1); }
    float opacity(size_t i) const { return _opacities ? _cloud.opacities[i] : 1.f; }
    /// Of splat `i`, coefficientCount() vectors; null: the colour is 0.5.
    const glm::vec3* coefficients(size_t i) const {
        return _coefficients ? _cloud.coefficients.data() + i * coefficientCount() : nullptr;
    }

    bool drawable(size_t i) const {
        const glm::quat q = orientation(i);
        const glm::vec3 s = scale(i);
        const float length = glm::length(q);
        if (!finite(position(i)) || !finite(s) || !(glm::min(s.x, glm::min(s.y, s.z)) >= 0.f)) return false;
        if (!std::isfinite(length) || !(length > 1e-6f) || !std::isfinite(opacity(i))) return false;
        const glm::vec3* c = coefficients(i);
        for (uint32_t k = 0; c && k < coefficientCount(); ++k)
            for (int channel = 0; channel < 3; ++channel)
                if (!(std::abs(c[k][channel]) <= HalfMaximum)) return false;
        return true;
    }

private:
    template <class T> bool full(const std::vector<T>& values, size_t each) const {
        return !values.empty() && values.size() >= _cloud.size() * each;
    }
    const SplatCloud& _cloud;
    bool _orientations, _scales, _opacities, _coefficients;
};

/// The largest power of two with which all scales are below 2^16 when divided by it.
float scaleUnit(float largest) {
    return largest > 0.f ? std::ldexp(1.f, std::max(std::ilogb(largest) - 15, -120)) : 1.f;
}

glm::uvec4 packShape(const glm::quat& orientation, const glm::vec3& scale, float opacity) {
    const glm::quat q = glm::normalize(orientation);
    const float kept = opacity >= 1.f / 255.f ? std::min(opacity, 1.f) : 0.f;
    const uint32_t last = glm::packHalf1x16(std::min(scale.z, HalfMaximum));
    return {glm::packSnorm2x16({q.x, q.y}), glm::packSnorm2x16({q.z, q.w}),
            glm::packHalf2x16(glm::min(glm::vec2(scale), HalfMaximum)),
            last | uint32_t(std::lround(kept * 65535.f)) << 16};
}

/// What the host prepares of a cloud before it is copied.
struct Packed {
    std::vector<glm::uvec4> shapes;
    std::vector<uint16_t> coefficients;
    SplatBounds bounds;
    float scaleUnit = 1.f;
    size_t broken = 0;
};

/// Drawable splats and their bounds.
Packed survey(const Splats& splats, size_t count, std::vector<uint8_t>* drawable) {
    Packed packed;
    std::mutex mutex;
    drawable->resize(count);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 4096), [&](const auto& range) {
        SplatBounds bounds;
        size_t broken = 0;
        for (size_t i = range.begin(); i != range.end(); ++i) {
            (*drawable)[i] = splats.drawable(i);
            if (!(*drawable)[i]) {
                ++broken;
                continue;
            }
            const glm::vec3 s = splats.scale(i), p = splats.position(i);
            bounds.add({p, p, std::max({s.x, s.y, s.z})});
        }
        std::lock_guard lock(mutex);
        packed.bounds.add(bounds);
        packed.broken += broken;
    });
    packed.scaleUnit = scaleUnit(packed.bounds.deviation);
    return packed;
}

Packed pack(const Splats& splats, size_t count) {
    std::vector<uint8_t> drawable;
    Packed packed = survey(splats, count, &drawable);
    packed.shapes.resize(count);
    const size_t halves = 3 * shCoefficients(splats.degree()), stride = (halves + 3) / 6 * 6;
    const bool coloured = count > 0 && splats.coefficients(0);
    packed.coefficients.resize(coloured ? count * stride : 0);
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, 4096), [&](const auto& range) {
        for (size_t i = range.begin(); i != range.end(); ++i) {
            if (!drawable[i]) continue; // zeros: opacity 0
            packed.shapes[i] =
                packShape(splats.orientation(i), splats.scale(i) / packed.scaleUnit, splats.opacity(i));
            const float* c = coloured ? &splats.coefficients(i)->x : nullptr;
            for (size_t k = 0; c && k < halves; ++k)
                packed.coefficients[i * stride + k] = glm::packHalf1x16(c[k]);
        }
    });
    return packed;
}

} // namespace

SplatStore::SplatStore(Device& device, const SplatCloud& cloud)
    : _size(cloud.size()), _sorting(cloud.sorting), _projection(cloud.projection) {
    const Splats splats(cloud);
    const Packed packed = pack(splats, _size);
    _bounds = packed.bounds;
    _broken = packed.broken;
    if (_broken && device.messages())
        device.messages()(
            Severity::Warning, cloud.name,
            std::to_string(_broken) + " of " + std::to_string(_size) +
                " splats are broken and not drawn: not finite, a negative scale, or no orientation");
    _positions = device.createFrom(cloud.positions.data(), _size, "splats");
    _shapes = device.createFrom(packed.shapes.data(), _size, "splats");
    if (!packed.coefficients.empty())
        _coefficients = device.createFrom(packed.coefficients.data(), packed.coefficients.size(), "splats");
    _arrays.positions = _positions.address();
    _arrays.shapes = _shapes.address();
    _arrays.coefficients = _coefficients ? _coefficients.address() : 0;
    _arrays.count = uint32_t(_size);
    _arrays.degree = splats.degree();
    _arrays.scaleUnit = packed.scaleUnit;
}

uint64_t SplatStore::bytes() const {
    return _positions.bytes() + _shapes.bytes() + _coefficients.bytes();
}

} // namespace hipr
