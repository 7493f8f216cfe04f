// One step of a shadow ray through surfaces that let light straight through: attenuates by the surface met and goes on
// behind it, or arrives when there is none.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"
#include "material/presence.glsl"

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_TRANSMIT + push.turn].count) return;
    const Hit hit = HitRef(trace.transmitHits).v[i];
    ShadowWork work = ShadowWorkRef(trace.transmitWork[push.turn]).v[i];
    if (hit.instance == NO_INDEX) {
        arrive(trace, work);
        return;
    }
    Ray ray = RayRef(trace.transmitRays[push.turn]).v[i];
    const float opacity = evaluatePresence(SceneRef(trace.scene).v, hit);
    if (!(opacity < 1.0)) return;
    work.contribution *= 1.0 - opacity;
    ray.tMin = passedDistance(hit.t);
    const uint other = 1u - push.turn;
    const uint j = appendToQueue(trace, QUEUE_TRANSMIT + other);
    RayRef(trace.transmitRays[other]).v[j] = ray;
    ShadowWorkRef(trace.transmitWork[other]).v[j] = work;
}
