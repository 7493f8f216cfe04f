#version 460
#extension GL_GOOGLE_include_directive : require
// Traces a queue by ray query. HIPR_OCCLUSION: blocked or not; else the nearest hit.
#include "accel/trace_kernel.glsl"
#include "accel/ray_query.glsl"

void main() {
    uint i = rayIndex();
    if (!inQueue(i)) return;
#ifdef HIPR_OCCLUSION
    const bool any = true;
#else
    const bool any = false;
#endif
    writeResult(i, traceRayQuery(SceneRef(push.scene).v, RayRef(push.rays).v[i], push.mask, any));
}
