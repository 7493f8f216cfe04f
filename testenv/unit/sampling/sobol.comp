// Writes sobol4 for (pixel, sample) = (first pixel + i / samples, i % samples), and filter offsets.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shared/references.glsl"
#include "sampling/sobol.glsl"
#include "sampling/filter.glsl"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer PointsRef { vec4 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer OffsetsRef { vec2 v[]; };
layout(push_constant, scalar) uniform Push {
    uint64_t points;
    uint64_t offsets;
    uvec2 pixel;
    uint samples, count, dimensionSet, seed, filterKind;
    float filterWidth;
} push;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const uvec2 pixel = push.pixel + uvec2(i / push.samples, 0u);
    const vec4 u = sobol4(pixel, i % push.samples, push.dimensionSet, push.seed);
    PointsRef(push.points).v[i] = u;
    OffsetsRef(push.offsets).v[i] = sampleFilter(push.filterKind, push.filterWidth, u.xy);
}
