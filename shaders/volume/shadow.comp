// What volumes leave of the light of shadow rays: ratio tracking (J. Novak, A. Selle, W. Jarosz, "Residual Ratio Tracking
// for Estimating Attenuation in Participating Media", 2014). Between `occluded` and `shadow`.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"
#include "sampling/sobol.glsl"
#include "volume/field.glsl"

// Rays with less than this left go on by chance.
const float LEAST_SHARE = 0.1;

// An estimate of the share of light that gets through a volume between two points of a placed ray.
vec3 throughVolume(uint64_t volumes, uint index, Ray ray, float u, uint random) {
    const FieldRecord density = VolumeRef(volumes).v[index].density;
    const vec3 extinction = VolumeRef(volumes).v[index].extinction;
    const float densest = VolumeRef(volumes).v[index].densest;
    vec3 share = vec3(1.0);
    FieldWalk walk;
    if (!beginWalk(density, ray.origin, ray.direction, ray.tMin, ray.tMax, walk)) return share;
    walk.left = exponential(u);
    [[dont_unroll]] while (true) {
        const float rate = nextStop(density, walk, densest, 0.0);
        if (rate == 0.0) return share;
        share *= max(1.0 - densityAtStop(density, walk) * extinction / rate, 0.0);
        const float most = max(share.x, max(share.y, share.z));
        if (most < LEAST_SHARE) {
            if (nextRandom(random) * LEAST_SHARE >= most) return vec3(0.0);
            share *= LEAST_SHARE / most;
        }
        walk.left = exponential(nextRandom(random));
    }
    return share;
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_SHADOW + push.turn].count) return;
    ShadowWorkRef works = ShadowWorkRef(trace.shadowWork);
    if (SlotRef(trace.shadowResults).v[i] != 0u && works.v[i].shadow == 0ul) return;
    const SceneRecord scene = SceneRef(trace.scene).v;
    const Ray ray = RayRef(trace.shadowRays).v[i];
    const uint slot = works.v[i].slot & ~SHADOW_INDIRECT, event = works.v[i].event;
    const uint pixel = PathRef(trace.paths).v[slot].pixel, sample_ = PathRef(trace.paths).v[slot].sampleIndex;
    const vec3 inverse = inverseDirection(ray.direction);
    vec3 share = vec3(1.0);
    for (uint k = 0u; k < scene.volumeCount; ++k) {
        if (!meetsVolume(scene.volumes, k, ray.origin, inverse, ray.tMin, ray.tMax)) continue;
        const uint set = hashCombine(VolumeRef(scene.volumes).v[k].seed, 2u * event + 1u);
        const vec4 u = sobol4(uvec2(pixel & 0xffffu, pixel >> 16), sample_, set, trace.seed);
        share *= throughVolume(scene.volumes, k, placedRay(scene.volumes, k, ray), u.x, floatBitsToUint(u.y) ^ hashUint(pixel) ^ set);
    }
    works.v[i].contribution *= share;
    if (share == vec3(0.0)) SlotRef(trace.shadowResults).v[i] = 1u;
}
