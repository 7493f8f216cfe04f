// The phase function of volumes; sampled by samplePhase in material/medium.glsl.
#ifndef HIPR_VOLUME_PHASE_GLSL
#define HIPR_VOLUME_PHASE_GLSL
#include "material/medium.glsl"

// Density per solid angle of a turn by the angle with this cosine.
float phaseDensity(float cosine, float anisotropy) {
    const float g = anisotropy, d = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * PI * d * sqrt(max(d, 1e-12)));
}
#endif
