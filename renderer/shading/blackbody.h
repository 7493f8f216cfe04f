/// @file blackbody.h
#pragma once

#include <glm/glm.hpp>

namespace hipr {

/// The colour of a black body in linear Rec.709, scaled to luminance 1, channels outside the gamut set to 0:
/// the behaviour that UsdLux documents for inputs:colorTemperature. Kelvin, clamped to 1000..10000. Planck's
/// law integrated over the CIE 1931 observer in the analytic form of C. Wyman, P.-P. Sloan and P. Shirley,
/// "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", JCGT 2(2), 2013, eq. 4.
glm::vec3 blackbodyColor(float kelvin);

} // namespace hipr
