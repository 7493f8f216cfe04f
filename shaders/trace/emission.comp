// What emissive surfaces send along the shadow rays that end on them; before `shadow`. The kernel that samples lights does
// without: it would have to evaluate a second material.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"
#include "material/surface.glsl"

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_SHADOW + push.turn].count) return;
    const Hit end = HitRef(trace.shadowEnds).v[i];
    ShadowWorkRef works = ShadowWorkRef(trace.shadowWork);
    const bool blocked = SlotRef(trace.shadowResults).v[i] != 0u;
    if (end.instance == NO_INDEX || (blocked && works.v[i].shadow == 0ul)) return;
    const Surface surface = evaluateSurface(SceneRef(trace.scene).v, end, RayRef(trace.shadowRays).v[i], NO_FOOTPRINT);
    works.v[i].contribution *= surface.opacity * surface.emission;
}
