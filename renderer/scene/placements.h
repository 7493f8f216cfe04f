/// @file placements.h
/// What a placement must be like to be rendered.
#pragma once

#include <cmath>

#include <glm/glm.hpp>

namespace hipr {

inline bool finite(const glm::dmat4x3& m) {
    for (int c = 0; c < 4; ++c)
        if (!std::isfinite(m[c].x) || !std::isfinite(m[c].y) || !std::isfinite(m[c].z)) return false;
    return true;
}

inline glm::dmat4x3 inverseOf(const glm::mat4x3& m) {
    return glm::dmat4x3(glm::inverse(
        glm::dmat4(glm::dvec4(m[0], 0), glm::dvec4(m[1], 0), glm::dvec4(m[2], 0), glm::dvec4(m[3], 1))));
}

inline bool canBeRendered(const glm::mat4x3& m) {
    return finite(glm::dmat4x3(m)) && finite(inverseOf(m)) && finite(glm::dmat4x3(glm::mat4x3(inverseOf(m))));
}

inline bool mirrors(const glm::mat4x3& m) {
    return glm::dot(glm::cross(m[0], m[1]), m[2]) < 0;
}

} // namespace hipr
