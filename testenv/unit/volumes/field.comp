// What the shipped GLSL says of fields and phase functions.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "volume/field.glsl"
#include "volume/phase.glsl"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer OutRef { vec4 v[]; };
layout(push_constant, scalar) uniform Push {
    uint64_t volumes; // VolumeRecord[1]
    uint64_t points;  // vec3[count]
    uint64_t result;  // vec4[count]
    uint count;
    float anisotropy;
    uint what;        // 0: the density at points; 1: a direction scattered from +z, and its density
} push;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    if (push.what == 0u) {
        OutRef(push.result).v[i] = vec4(fieldValue(VolumeRef(push.volumes).v[0].density, Vec3Ref(push.points).v[i]), 0.0);
        return;
    }
    uint random = i * 747796405u;
    const float a = nextRandom(random), b = nextRandom(random);
    const vec3 wi = samplePhase(vec3(0.0, 0.0, 1.0), push.anisotropy, vec2(a, b));
    OutRef(push.result).v[i] = vec4(wi, phaseDensity(wi.z, push.anisotropy));
}
