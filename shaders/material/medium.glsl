// Light in homogeneous media: free flights, phase functions, and the wavelength of dispersed light.
#ifndef HIPR_MATERIAL_MEDIUM_GLSL
#define HIPR_MATERIAL_MEDIUM_GLSL
#include "material/frame.glsl"
#include "shared/references.glsl"

uint packMediumColor(vec3 color) {
    uvec3 steps = uvec3(clamp(color, 0.0, 1.0) * 1023.0 + 0.5);
    return steps.x | steps.y << 10 | steps.z << 20;
}

vec3 unpackMediumColor(uint color) {
    return vec3(color & 1023u, color >> 10 & 1023u, color >> 20 & 1023u) / 1023.0;
}

// Three numbers above 0 with 9 bits each and one exponent.
uint packMediumRadius(vec3 radius) {
    const float largest = clamp(max(radius.x, max(radius.y, radius.z)), 1e-6, 3e4);
    const float exponent = floor(log2(largest)) + 1.0;
    const uvec3 steps = uvec3(clamp(radius * exp2(9.0 - exponent) + 0.5, vec3(1.0), vec3(511.0)));
    return steps.x | steps.y << 9 | steps.z << 18 | uint(exponent + 24.0) << 27;
}

vec3 unpackMediumRadius(uint radius) {
    const vec3 steps = vec3(radius & 511u, radius >> 9 & 511u, radius >> 18 & 511u);
    return steps * exp2(float(radius >> 27) - 24.0 - 9.0);
}

// The albedo of single scattering that makes a half-space reflect `color`: H. van de Hulst's approximation as the OpenPBR
// specification inverts it ("Subsurface").
vec3 scatteringAlbedo(vec3 color, float anisotropy) {
    vec3 s = 4.09712 + 4.20863 * color - sqrt(9.59217 + 41.6808 * color + 17.7126 * color * color);
    s = clamp(s, 0.0, 1.0);
    return (1.0 - s * s) / (1.0 - anisotropy * s * s);
}

// How often each channel decides on the length of a flight: by the light it carries.
vec3 flightChances(MediumRecord medium, vec3 throughput) {
    vec3 carried = abs(throughput) * medium.albedo;
    float sum = carried.x + carried.y + carried.z;
    return sum > 0.0 ? carried / sum : vec3(1.0 / 3.0);
}

// The length of a free flight; `u` is uniform.
float sampleFlight(MediumRecord medium, vec3 throughput, float u) {
    vec3 chances = flightChances(medium, throughput);
    float chance = chances.x, extinction = medium.extinction.x;
    if (u >= chance) u -= chance, chance = chances.y, extinction = medium.extinction.y;
    if (u >= chance) u -= chance, chance = chances.z, extinction = medium.extinction.z;
    return -log(1.0 - clamp(u / max(chance, 1e-6), 0.0, 0.99999994)) / extinction;
}

// The weight of a flight of length `distance_` that scattering ended, or a surface. Without scattering flights are not
// sampled, and only absorbed.
vec3 flightWeight(MediumRecord medium, vec3 throughput, float distance_, bool scattered) {
    vec3 through = exp(-medium.extinction * distance_);
    if (medium.albedo == vec3(0.0)) return through;
    vec3 density = scattered ? medium.extinction * through : through;
    float pdf = dot(flightChances(medium, throughput), density);
    return pdf > 0.0 ? (scattered ? medium.albedo : vec3(1.0)) * density / pdf : vec3(0.0);
}

// L. Henyey and J. Greenstein, "Diffuse radiation in the galaxy", 1941; sampled exactly, so that the weight is 1.
vec3 samplePhase(vec3 direction, float anisotropy, vec2 u) {
    float g = anisotropy, cosine = 1.0 - 2.0 * u.x;
    if (abs(g) > 1e-3) {
        float q = (1.0 - g * g) / (1.0 - g + 2.0 * g * u.x);
        cosine = (1.0 + g * g - q * q) / (2.0 * g);
    }
    float sine = sqrt(max(0.0, 1.0 - cosine * cosine)), phi = 2.0 * PI * u.y;
    return normalize(frameAround(direction) * vec3(sine * cos(phi), sine * sin(phi), cosine));
}

// A wavelength in nanometres and its colour: three overlapping bands whose mean is white.
float sampleWavelength(float u, out vec3 color) {
    const vec3 centres = vec3(0.72, 0.5, 0.28);
    const float width = 0.28;
    color = max(1.0 - abs(u - centres) / width, 0.0) / width;
    return 400.0 + 300.0 * u;
}

// The index of refraction at a wavelength: Cauchy's formula from the index at 587.6 nm and the Abbe number (OpenPBR
// specification, "Translucent base").
float dispersedIndex(float index, float abbe, float wavelength) {
    const float d = 1.0 / (587.6 * 587.6), spread = 1.0 / (486.1 * 486.1) - 1.0 / (656.3 * 656.3);
    return index + (index - 1.0) / (abbe * spread) * (1.0 / (wavelength * wavelength) - d);
}
#endif
