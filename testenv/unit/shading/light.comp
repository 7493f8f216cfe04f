// A white Lambert receiver (albedo 1, so radiance * pi = irradiance) at one point, lit without occlusion. Invocation i
// draws a light sample and a cosine-weighted direction, and looks along directions[i]. It also walks the tree of lights to
// where a random number leads, and to light i, or the i-th after them all.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "light/hit.glsl"
#include "sampling/sobol.glsl"

layout(local_size_x = 64) in;

struct LightOutcome {
    vec3 wi;        // light sample
    float pdf;      // 0: no sample
    vec3 byLight;   // irradiance estimated by light sampling alone
    float atSample; // weight that meeting the light at wi has against a BSDF of equal density: 1/2 if the pdfs agree
    vec3 byMeeting; // by cosine-weighted directions alone
    float distance;
    vec3 combined;  // by both, weighted
    uint chosen;    // by the tree
    float chance;   // that the walk came there
    float chanceOf; // light i % their number
    vec3 seen;      // radiance along directions[i], as the camera sees it
    vec3 weighted;  // the same met by a BSDF sample of density 1
};

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer OutcomeRef { LightOutcome v[]; };
layout(push_constant, scalar) uniform Push {
    uint64_t scene, directions, outcomes;
    vec3 point, normal;
    uint count;
} push;

vec3 met(SceneRecord scene, vec3 direction, bool cameraRay, float bsdfPdf) {
    return lightsAlongRay(scene, Ray(push.point, 0.0, direction, 1e30, 0.0, 0u), 1e30, cameraRay, bsdfPdf, push.normal, 0u) +
           environmentRadiance(scene, direction, cameraRay, bsdfPdf, 0u);
}

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const SceneRecord scene = SceneRef(push.scene).v;
    LightOutcome result;
    result.byLight = result.combined = vec3(0.0);
    result.pdf = result.atSample = 0.0;
    LightSample ls;
    if (sampleLight(scene, push.point, push.normal, 0u, sobol4(uvec2(3, 1), i, 0u, 0u), ls)) {
        const float cosine = max(0.0, dot(ls.wi, push.normal));
        result.wi = ls.wi;
        result.pdf = ls.pdf;
        result.distance = ls.distance;
        result.byLight = ls.radiance * ls.lobeScale.x * cosine / ls.pdf;
        result.combined = result.byLight * lightMisWeight(ls, cosine / PI);
        result.atSample = met(scene, ls.wi, false, ls.pdf).g / ls.radiance.g;
    }
    const vec4 u = sobol4(uvec2(3, 1), i, 1u, 0u);
    const float r = sqrt(u.x), phi = 2.0 * PI * u.y;
    const vec3 wi = frameAround(push.normal) * vec3(r * cos(phi), r * sin(phi), sqrt(1.0 - u.x));
    result.byMeeting = PI * met(scene, wi, false, -1.0);
    result.combined += PI * met(scene, wi, false, dot(wi, push.normal) / PI);
    const vec3 direction = Vec3Ref(push.directions).v[i];
    result.seen = met(scene, direction, true, -1.0);
    result.weighted = met(scene, direction, false, 1.0);
    result.chosen = NO_INDEX;
    result.chance = result.chanceOf = 0.0;
    if (scene.lightTreeChance > 0.0) {
        result.chance = walkLightTree(scene, Receiver(push.point, push.normal, 0u), NO_INDEX, sobol4(uvec2(3, 1), i, 2u, 0u).x, result.chosen);
        const uint leaf = LightRef(scene.lights).v[i % (scene.lightCount - scene.infiniteLightCount)].leaf;
        uint same;
        result.chanceOf = walkLightTree(scene, Receiver(push.point, push.normal, 0u), leaf, 0.0, same);
    }
    OutcomeRef(push.outcomes).v[i] = result;
}
