// What rays find at given hits.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "material/surface.glsl"
#include "material/presence.glsl"

layout(local_size_x = 64) in;

struct SurfaceOutcome {
    vec3 position, ng, ns, tangent, emission, albedo, diffuse, f0;
    float opacity, presence, alpha, coat, coatAlpha, glass, eta;
    uint frontFacing;
};

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer HitRef { Hit v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayRef { Ray v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer OutcomeRef { SurfaceOutcome v[]; };
layout(push_constant, scalar) uniform Push { uint64_t scene, hits, rays, outcomes; uint count; float width, levelShare; uint sampled; } push;

void main() {
    const uint i = gl_GlobalInvocationID.x;
    if (i >= push.count) return;
    const SceneRecord scene = SceneRef(push.scene).v;
    const Hit hit = HitRef(push.hits).v[i];
    const Ray ray = RayRef(push.rays).v[i];
    const RayFootprint footprint = RayFootprint(push.width, push.levelShare, push.sampled != 0u);
    const Surface s = evaluateSurface(scene, hit, ray, footprint);
    OutcomeRef(push.outcomes).v[i] =
        SurfaceOutcome(s.position, s.ng, s.ns, s.tangent, s.emission, s.albedo, s.diffuse, s.f0, s.opacity,
                       evaluatePresence(scene, hit, ray.time), s.alpha.x, s.coat, s.coatAlpha.x, s.glass, s.eta,
                       s.frontFacing ? 1u : 0u);
}
