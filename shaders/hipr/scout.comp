// Compares the samples of a scout with the same samples in the picture on display. One invocation a path.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FirstSampleRef { vec3 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer ScoutResultRef { ScoutResult v[]; };

float channelMean(vec3 v) { return (v.r + v.g + v.b) / 3.0; }

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const PathState path = PathRef(trace.paths).v[i];
    const uint x = path.pixel & 0xffffu, y = path.pixel >> 16;
    const vec3 radiance = pathRadiance(trace, path);
    const vec3 difference = radiance - FirstSampleRef(trace.firstSamples).v[x + y * trace.width];
    ScoutResultRef(trace.scoutResults).v[i] =
        ScoutResult(path.pixel, channelMean(abs(difference)), channelMean(radiance));
}
