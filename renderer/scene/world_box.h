/// @file world_box.h
/// An axis-aligned box in world space.
#pragma once

#include <limits>

#include <glm/glm.hpp>

namespace hipr {

struct WorldBox {
    glm::vec3 min{std::numeric_limits<float>::max()}, max{std::numeric_limits<float>::lowest()};

    bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
    void add(const WorldBox& o) {
        min = glm::min(min, o.min);
        max = glm::max(max, o.max);
    }
};

} // namespace hipr
