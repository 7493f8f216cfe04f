// Light that arrives: adds the contribution of shadow rays that nothing opaque blocks. Where the scene has surfaces
// that let rays straight through, survivors go on to the transmit queue instead; and so do those that something blocks
// if the light's shadows are not plain, for another look at what it is.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_SHADOW + push.turn].count) return;
    const bool blocked = SlotRef(trace.shadowResults).v[i] != 0u;
    const ShadowWork work = ShadowWorkRef(trace.shadowWork).v[i];
    if (blocked && work.shadow == 0ul) return;
    if (!blocked && (SceneRef(trace.scene).v.flags & SCENE_HAS_NON_OPAQUE) == 0u) {
        arrive(trace, work, vec3(work.weight));
        return;
    }
    const uint j = appendToQueue(trace, QUEUE_TRANSMIT);
    RayRef(trace.transmitRays[0]).v[j] = RayRef(trace.shadowRays).v[i];
    TransmitWorkRef(trace.transmitWork[0]).v[j] = TransmitWork(work, 1.0, 0.0, vec3(0.0));
}
