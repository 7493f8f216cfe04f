/// @file bounds.h
/// Axis-aligned boxes.
#pragma once

#include <limits>

#include <glm/glm.hpp>

namespace hipr {

/// Empty until something was added: lo > hi.
struct Bounds {
    glm::vec3 lo{std::numeric_limits<float>::max()};
    glm::vec3 hi{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& p) {
        lo = glm::min(lo, p);
        hi = glm::max(hi, p);
    }
    void add(const Bounds& b) {
        lo = glm::min(lo, b.lo);
        hi = glm::max(hi, b.hi);
    }
    bool empty() const { return lo.x > hi.x; }
    /// Half the surface; 0 for an empty box.
    float halfArea() const {
        if (empty()) return 0.0f;
        const glm::vec3 d = hi - lo;
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }
    /// Largest |coordinate|; 0 for an empty box.
    float extent() const {
        if (empty()) return 0.0f;
        const glm::vec3 m = glm::max(glm::abs(lo), glm::abs(hi));
        return glm::max(m.x, glm::max(m.y, m.z));
    }
};

} // namespace hipr
