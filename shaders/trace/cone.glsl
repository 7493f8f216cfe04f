// How much of a texture a path covers: a cone around its ray.
//
// A sample stands for a share of all that is sampled: of its pixel, of the lens, of the directions into which a surface
// scatters. The sample of index k is read as one of k + 1 that share them, so that its cone is 1 / sqrt(k + 1) as wide. A
// picture of few samples is filtered as if by mip maps; with more samples the filter vanishes, and what is left is the
// sharp picture. M. Pharr et al., "Physically Based Rendering", 4th edition, section 10.1, narrow all rays alike by
// 1 / sqrt(samples); here pictures do not depend on how many samples are still to come.
//
// Cones: T. Akenine-Moller et al., "Texture Level of Detail Strategies for Real-Time Ray Tracing", Ray Tracing Gems, 2019.
// Curvature is left out: what a bulging mirror shows is filtered less than it could be.
#ifndef HIPR_TRACE_CONE_GLSL
#define HIPR_TRACE_CONE_GLSL
#include "material/frame.glsl"
#include "trace/camera.glsl"

// No sample is taken for less than 1 / 64 of its pixel: texels that lie closer together than any picture could show would
// only cost memory traffic.
const float LEAST_CONE = 0.125;
// The width of the cone of a scattered ray: of the square that has this share of the solid angle that its direction stands
// for, which is 1 / density.
const float LOBE_SHARE = 0.0625;

// The cone of a camera ray: its width at the origin, and how much it grows per length. Negative widths are meant: behind a
// lens it narrows, to open again behind the focus.
vec2 cameraCone(CameraRef camera, vec2 film, uvec2 size) {
    const vec2 ndc = 2.0 * film / vec2(size) - 1.0;
    const vec3 direction = camera.v.direction + ndc.x * camera.v.directionX + ndc.y * camera.v.directionY;
    const float scale = length(direction), pixel = 2.0 * inversesqrt(float(size.x) * float(size.y));
    const vec3 unit = direction / scale;
    const float angle = sqrt(abs(dot(cross(camera.v.directionX, camera.v.directionY), unit))) / scale;
    const float side = sqrt(abs(dot(cross(camera.v.originX, camera.v.originY), unit)));
    const float lens = sqrt(length(camera.v.lensX) * length(camera.v.lensY));
    const float focus = lens > 0.0 ? camera.v.focusDepth / dot(unit, camera.v.forward) : 1.0;
    return vec2(pixel * side + lens, pixel * angle - lens / focus);
}

// Narrower for later samples. Samples of the pilot tell how noisy late ones are.
float coneOfSample(TraceRecord trace, uint sampleIndex) {
    const bool pilot = trace.pilot > 0u && (sampleIndex & SECOND_SAMPLE_SET) == 0u;
    return pilot ? LEAST_CONE : max(inversesqrt(float(sampleIndex & ~SECOND_SAMPLE_SET) + 1.0), LEAST_CONE);
}

// A cone at the end of a flight.
vec2 flownCone(vec2 cone, float distance_) { return vec2(cone.x + cone.y * distance_, cone.y); }

// A cone after scattering into a direction that was drawn with the density `pdf`; below 0: an unknown, small one.
vec2 scatteredCone(vec2 cone, float pdf) {
    const float solidAngle = LOBE_SHARE * (pdf > 0.0 ? 1.0 / pdf : PI);
    return vec2(abs(cone.x), sqrt(cone.y * cone.y + solidAngle));
}
#endif
