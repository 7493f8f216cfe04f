#include "renderer/shading/blackbody.h"

#include <algorithm>
#include <cmath>

namespace hipr {

namespace {

/// A Gaussian with its own width on each side of its peak, the building block of the fit.
double lobe(double nm, double peak, double inverseBelow, double inverseAbove) {
    const double t = (nm - peak) * (nm < peak ? inverseBelow : inverseAbove);
    return std::exp(-0.5 * t * t);
}

glm::dvec3 observer(double nm) {
    return {1.056 * lobe(nm, 599.8, 0.0264, 0.0323) + 0.362 * lobe(nm, 442.0, 0.0624, 0.0374) -
                0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
            0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
            1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

/// Planck's law up to a constant factor; c2 = h c / k in nm K.
double planck(double nm, double kelvin) {
    constexpr double C2 = 1.438776877e7;
    return std::pow(nm / 560.0, -5.0) / std::expm1(C2 / (nm * kelvin));
}

} // namespace

glm::vec3 blackbodyColor(float kelvin) {
    const double temperature = std::clamp(double(kelvin), 1000.0, 10000.0);
    glm::dvec3 xyz(0.0);
    for (int nm = 360; nm <= 830; nm += 5)
        xyz += observer(nm) * planck(nm, temperature);
    // ITU-R BT.709 primaries, white D65.
    const glm::dvec3 rgb(3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
                         -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
                         0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z);
    const double luminance = glm::dot(rgb, glm::dvec3(0.2126, 0.7152, 0.0722));
    return glm::vec3(glm::max(rgb / luminance, glm::dvec3(0.0)));
}

} // namespace hipr
