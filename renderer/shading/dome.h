/// @file dome.h
/// Importance table of a dome light's picture.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/shading/image.h"

namespace hipr {

/// A piecewise-constant density over a latitude-longitude picture; the layout of `values` is that of
/// shaders/light/environment.glsl. Empty for a black picture.
struct DomeTable {
    uint32_t width = 0, height = 0;
    std::vector<float> values;
    glm::vec3 mean{0.f}; ///< radiance of the picture averaged over the sphere
};

/// At most 1024 x 512 cells; each weighs the integral of bilinear luminance over its texels times the sine of
/// the polar angle, so that no direction that sends light has density 0.
DomeTable buildDomeTable(const Image& image);

} // namespace hipr
