/// @file bounds.h
/// How far a cloud of splats reaches.
#pragma once

#include <limits>

#include "renderer/api/splats.h"

namespace hipr {

/// A box in object space.
struct SplatBox {
    glm::vec3 lo{std::numeric_limits<float>::max()}, hi{std::numeric_limits<float>::lowest()};

    bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
    void add(const SplatBox& o) {
        lo = glm::min(lo, o.lo);
        hi = glm::max(hi, o.hi);
    }
};

/// The box around all splats of a cloud, each up to so many standard deviations. Those with numbers that are
/// not finite do not count; without any that do, it is empty. Works on several threads.
SplatBox splatBox(const SplatCloud& cloud, float deviations);

} // namespace hipr
