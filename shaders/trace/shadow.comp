// Light that arrives: adds the contribution of shadow rays that nothing opaque blocks. Where the scene has surfaces
// that let rays straight through, survivors go on to the transmit queue instead.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_SHADOW + push.turn].count) return;
    if (SlotRef(trace.shadowResults).v[i] != 0u) return;
    const ShadowWork work = ShadowWorkRef(trace.shadowWork).v[i];
    if ((SceneRef(trace.scene).v.flags & SCENE_HAS_NON_OPAQUE) == 0u) {
        arrive(trace, work);
        return;
    }
    const uint j = appendToQueue(trace, QUEUE_TRANSMIT);
    RayRef(trace.transmitRays[0]).v[j] = RayRef(trace.shadowRays).v[i];
    ShadowWorkRef(trace.transmitWork[0]).v[j] = work;
}
