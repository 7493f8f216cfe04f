/// @file arrays.h
/// All arrays of a cloud at once.
#pragma once

#include "renderer/api/splats.h"

namespace hipr {

/// Calls f(array, length) with each array and the length it has for `count` splats of the cloud's degree.
template <class F> void forEachArray(SplatCloud& cloud, size_t count, F&& f) {
    f(cloud.positions, count);
    f(cloud.orientations, count);
    f(cloud.scales, count);
    f(cloud.opacities, count);
    f(cloud.coefficients, count * shCoefficients(cloud.shDegree));
}

} // namespace hipr
