// Fills the table of stretched albedos: a workgroup makes one row. See renderer/shading/stretched_albedo.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "material/microfacet.glsl"
#include "shared/hemisphere.h"

layout(local_size_x = 64) in;
layout(buffer_reference, scalar, buffer_reference_align = 8) writeonly buffer TableRef { vec2 v[]; };
layout(push_constant, scalar) uniform Push { uint64_t table; } push;

shared vec2 sums[gl_WorkGroupSize.x];

struct Lobe {
    vec2 alpha;
    bool mirror; // reflects all light
    float eta;
};

Lobe lobeOf(uint row) {
    const uint plane = row / (STRETCHED_ROUGHNESSES * STRETCHED_ANISOTROPIES);
    const float x = float(row / STRETCHED_ROUGHNESSES % STRETCHED_ANISOTROPIES) / float(STRETCHED_ANISOTROPIES - 1u);
    const float roughness = float(row % STRETCHED_ROUGHNESSES) / float(STRETCHED_ROUGHNESSES - 1u);
    const float k = float(plane % STRETCHED_STEPS) / float(STRETCHED_STEPS - 1u), indexStep = INTERFACE_MOST * k * k;
    const float eta = (1.0 + indexStep) / (1.0 - indexStep);
    const vec2 alpha = stretchedAlpha(roughness, 1.0 - (1.0 - x) * (1.0 - x));
    return Lobe(alpha, plane == 2u * STRETCHED_STEPS, plane < STRETCHED_STEPS ? eta : 1.0 / eta);
}

// What a facet does with light from `o`.
vec2 facetOutcome(Lobe lobe, vec3 o, vec3 h, float lambdaO) {
    const float fresnel = lobe.mirror ? 1.0 : dielectricFresnel(min(dot(o, h), 1.0), lobe.eta);
    const float back = fresnel * reflectedPart(o, h, lobe.alpha, lambdaO);
    return vec2(back, back + (fresnel < 1.0 ? (1.0 - fresnel) * refractedPart(o, h, lobe.alpha, lobe.eta) : 0.0));
}

// Gauss and Legendre's quadrature with ten points, of which five mirror the others (M. Abramowitz and I. Stegun, "Handbook
// of Mathematical Functions", table 25.4).
const uint POINTS = 5u;
const float AT[POINTS] = float[](0.1488743390, 0.4333953941, 0.6794095683, 0.8650633667, 0.9739065285);
const float SHARE[POINTS] = float[](0.2955242247, 0.2692667193, 0.2190863625, 0.1494513492, 0.0666713443);

vec2 albedo(Lobe lobe, vec3 o) {
    // Around the disk of visible normals even steps are best: more of them where total reflection has an edge.
    const uint turns = lobe.eta < 1.0 ? 24u : 16u;
    const float lambdaO = ggxLambda(o, lobe.alpha);
    vec2 sum = vec2(0.0);
    for (uint turn = 0u; turn < turns; ++turn) {
        const float u = (float(turn) + 0.5) / float(turns);
        [[unroll]] for (uint k = 0u; k < 2u * POINTS; ++k) {
            const float v = k < POINTS ? 0.5 + 0.5 * AT[k] : 0.5 - 0.5 * AT[k - POINTS];
            sum += SHARE[k % POINTS] * facetOutcome(lobe, o, sampleVisibleNormal(o, lobe.alpha, vec2(u, v)), lambdaO);
        }
    }
    return sum / float(2u * turns);
}

// The integral of a hat of the linear interpolation in the cosine y of the azimuth, over a quarter of a turn.
float azimuthShare(uint node) {
    const float n = float(STRETCHED_AZIMUTHS - 1u), y = float(node) / n;
    const float before = max(y - 1.0 / n, 0.0), after = min(y + 1.0 / n, 1.0);
    const float sine = sqrt(1.0 - y * y), turn = acos(y);
    const float rising = sqrt(1.0 - before * before) - sine - before * (acos(before) - turn);
    const float falling = after * (turn - acos(after)) - (sine - sqrt(1.0 - after * after));
    return (rising + falling) * n * 2.0 / PI;
}

void main() {
    const uint row = gl_WorkGroupID.x, lane = gl_LocalInvocationID.x;
    const Lobe lobe = lobeOf(row);
    TableRef table = TableRef(push.table);
    vec2 mean = vec2(0.0);
    for (uint i = lane; i < STRETCHED_ROW - 1u; i += gl_WorkGroupSize.x) {
        const uint azimuth = i / STRETCHED_COSINES, node = i % STRETCHED_COSINES;
        const float x = float(node) / float(STRETCHED_COSINES - 1u), cosine = max(x * x, 1e-4);
        const float y = float(azimuth) / float(STRETCHED_AZIMUTHS - 1u), sine = sqrt(1.0 - cosine * cosine);
        const vec2 value = albedo(lobe, vec3(sine * y, sine * sqrt(1.0 - y * y), cosine));
        table.v[row * STRETCHED_ROW + i] = value;
        mean += value * (hemisphereShare(node, STRETCHED_COSINES) * azimuthShare(azimuth));
    }
    sums[lane] = mean;
    barrier();
    if (lane > 0u) return;
    for (uint i = 1u; i < gl_WorkGroupSize.x; ++i)
        mean += sums[i];
    table.v[row * STRETCHED_ROW + STRETCHED_ROW - 1u] = mean;
}
