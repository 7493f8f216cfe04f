// One step of a shadow ray through surfaces: attenuates by the surface met and goes on behind it, or arrives when there
// is none.
//
// Light that was stopped arrives as far as the light's shadows let it through; light that was stopped by an object that
// casts none of this light's shadows goes on beside the rest. Neither can be found by the BSDF's rays, which such
// surfaces do stop, so that it counts in full; what nothing stopped has its weight.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"
#include "light/linking.glsl"
#include "light/shadow.glsl"
#include "material/presence.glsl"

// Whether a surface belongs to the mesh that is the light. It hides its own far side whatever its shadows are, or it would
// give more light than a light of that shape; so light of a mesh does not arrive before all of its way is known.
bool ownSurface(TransmitWork transmit, Hit hit) {
    return transmit.work.shadow != 0ul && ShadowRef(transmit.work.shadow).v.instance == hit.instance;
}

// What the surface does to the light. Returns the share that gets through although it was stopped.
vec3 meetSurface(SceneRecord scene, Hit hit, float opacity, inout TransmitWork transmit) {
    const uint64_t address = transmit.work.shadow;
    const bool own = ownSurface(transmit, hit);
    if (address != 0ul && !own) {
        const uint set = InstanceRef(scene.instances).v[hit.instance].categories;
        if (!inCategory(scene, set, ShadowRef(address).v.category)) {
            transmit.aside += transmit.direct * opacity;
            transmit.direct *= 1.0 - opacity;
            return vec3(0.0);
        }
    }
    const float stopped = (transmit.direct + transmit.aside) * opacity;
    transmit.direct *= 1.0 - opacity;
    transmit.aside *= 1.0 - opacity;
    if (own) transmit.through *= 1.0 - opacity;
    return address == 0ul || own ? vec3(0.0) : stopped * throughOccluder(ShadowRef(address).v, hit.t);
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_TRANSMIT + push.turn].count) return;
    const Hit hit = HitRef(trace.transmitHits).v[i];
    TransmitWork transmit = TransmitWorkRef(trace.transmitWork[push.turn]).v[i];
    const bool free = hit.instance == NO_INDEX;
    const SceneRecord scene = SceneRef(trace.scene).v;
    Ray ray = RayRef(trace.transmitRays[push.turn]).v[i];
    vec3 share = free ? transmit.direct * transmit.work.weight + transmit.aside + transmit.through
                      : meetSurface(scene, hit, clamp(evaluatePresence(scene, hit, ray.time), 0.0, 1.0), transmit);
    if (!free && transmit.work.shadow != 0ul && ShadowRef(transmit.work.shadow).v.instance != NO_INDEX) {
        transmit.through += share;
        share = vec3(0.0);
    }
    arrive(trace, transmit.work, share);
    if (free || !(transmit.direct + transmit.aside + luminance(transmit.through) > 0.0)) return;
    ray.tMin = passedDistance(hit.t);
    const uint other = 1u - push.turn;
    const uint j = appendToQueue(trace, QUEUE_TRANSMIT + other);
    RayRef(trace.transmitRays[other]).v[j] = ray;
    TransmitWorkRef(trace.transmitWork[other]).v[j] = transmit;
}
