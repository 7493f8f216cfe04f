// Discovery by shadows: a shadow ray that comes past a place where something changed adds to the weight of the tile in
// which its origin shows, whether the place was vacated or is occupied now. Behind `shade`; one invocation a shadow ray.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/discovery.glsl"

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_SHADOW + push.turn].count) return;
    const DiscoveryRecord discovery = DiscoveryRef(trace.discovery).v;
    const uint slot = ShadowWorkRef(trace.shadowWork).v[i].slot & ~SHADOW_INDIRECT;
    const DiscoveryVertex vertex = DiscoveryVertexRef(discovery.vertices).v[slot];
    if (vertex.tile == NO_INDEX) return;
    const Ray ray = RayRef(trace.shadowRays).v[i];
    bool meets = false;
    for (uint k = 0u; k < discovery.boxCount && !meets; ++k)
        meets = meetsBox(ray.origin, ray.direction, ray.tMax, BoxRef(discovery.boxes).v[k], discovery.boxExtent);
    if (!meets) return;
    const float pixels = push.first != 0u ? discovery.scoutScale : 1.0;
    addWeight(discovery, vertex.tile, pixels * vertex.share * discovery.shadowWeight);
}
