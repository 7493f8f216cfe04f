// Interference in a film on an interface, for light of three broad bands.
#ifndef HIPR_MATERIAL_THIN_FILM_GLSL
#define HIPR_MATERIAL_THIN_FILM_GLSL
#include "material/frame.glsl"

// Wave numbers (radians a micrometre) at the middle of the bands, 610, 550 and 465 nm, and their standard deviations.
const vec3 FILM_WAVES = 2.0 * PI / vec3(0.610, 0.550, 0.465);
const vec3 FILM_BANDS = 0.055 * FILM_WAVES;

// Reflectance of a film (index and thickness in micrometres) on something that reflects `base` of the light in the film,
// met by light of cosine `cosine` from a medium of index 1, of which the film's upper side reflects `upper`.
// `sign_` is that of the product of both amplitudes. Airy's sum for waves that are reflected any number of times,
//   R = 1 - (1 - a^2)(1 - b^2) / (1 + (ab)^2 + 2 ab cos(phase)),
// as a Fourier series in the phase, each term averaged over Gaussian bands. As L. Belcour and P. Barla, "A Practical
// Extension to Microfacet Theory for the Modeling of Varying Iridescence", ACM TOG 36(4), 2017, but with these bands in the
// place of the eye's and without polarisation. Between 0 and 1.
vec3 filmReflectance(float cosineInFilm, float ior, float thickness, float upper, vec3 base, float sign_) {
    vec3 product = sign_ * sqrt(upper * base), path = vec3(2.0 * ior * thickness * cosineInFilm);
    vec3 phase = FILM_WAVES * path, spread = FILM_BANDS * path, damping = exp(-0.5 * spread * spread);
    vec3 first = -product * damping * cos(phase);
    vec3 damping2 = damping * damping, damping4 = damping2 * damping2; // of twice the phase: the fourth power
    vec3 second = product * product * damping4 * cos(2.0 * phase);
    vec3 series = 1.0 + 2.0 * (first + second - product * product * product * damping4 * damping4 * damping * cos(3.0 * phase));
    return clamp(1.0 - (1.0 - upper) * (1.0 - base) / max(1.0 - product * product, 1e-6) * series, 0.0, 1.0);
}
#endif
