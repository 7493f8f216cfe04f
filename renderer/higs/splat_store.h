/// @file splat_store.h
/// One cloud of splats on the device.
#pragma once

#include <algorithm>
#include <limits>

#include "renderer/api/splats.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/higs.h"

namespace hipr {

/// Where splats can be, in object space; lo > hi: there is none.
struct SplatBounds {
    glm::vec3 lo{std::numeric_limits<float>::max()}, hi{std::numeric_limits<float>::lowest()}; ///< of centres
    float deviation = 0.f; ///< the largest standard deviation

    void add(const SplatBounds& o) {
        lo = glm::min(lo, o.lo);
        hi = glm::max(hi, o.hi);
        deviation = std::max(deviation, o.deviation);
    }
};

/// What the kernels read of a cloud. A splat takes 28 + 6 * (degree + 1)^2 bytes, 124 at degree 3: its
/// position in float, a unit quaternion in 16-bit fixed point, scales in half precision relative to the
/// largest one, opacity in 16-bit fixed point, an even number of coefficients in half precision. The arrays
/// lie in buffers of their own and are read through device addresses, so that no binding limit applies.
///
/// Splats that cannot be drawn (a component that is not finite, a negative scale, an orientation of length 0,
/// coefficients beyond half precision) are left out, as are those whose opacity stays below 1/255; opacities
/// are clamped to 1. Those that were broken are told to the device's message sink in one warning.
class SplatStore {
public:
    /// Copies the cloud; arrays shorter than `positions` count as empty, longer ones are cut. Throws
    /// OutOfMemory.
    SplatStore(Device& device, const SplatCloud& cloud);

    size_t size() const { return _size; }
    /// Splats left out because they were broken.
    size_t broken() const { return _broken; }
    /// Device memory the arrays take.
    uint64_t bytes() const;
    /// Of the splats that can be drawn.
    const SplatBounds& bounds() const { return _bounds; }
    SplatSorting sorting() const { return _sorting; }
    SplatProjection projection() const { return _projection; }
    /// Addresses and constants for the kernels.
    const gpu::SplatArrays& arrays() const { return _arrays; }

private:
    size_t _size = 0, _broken = 0;
    SplatBounds _bounds;
    SplatSorting _sorting;
    SplatProjection _projection;
    Buffer _positions, _shapes, _coefficients;
    gpu::SplatArrays _arrays{};
};

} // namespace hipr
