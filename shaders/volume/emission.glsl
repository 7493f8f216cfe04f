// Light that volumes send by themselves.
#ifndef HIPR_VOLUME_EMISSION_GLSL
#define HIPR_VOLUME_EMISSION_GLSL
#include "trace/path.glsl"
#include "volume/field.glsl"

// Points of the comb that emission is summed at, by cell that a ray crosses along an axis.
const float COMB_PER_CELL = 1.0;

// What a black body of this temperature sends.
vec3 blackbodyRadiance(SceneRecord scene, float kelvin) {
    Vec3Ref table = Vec3Ref(scene.blackbody);
    const float last = float(BLACKBODY_STEPS - 1u);
    const float beyond = max(kelvin / BLACKBODY_LARGEST, 1.0), at = min(kelvin * last / BLACKBODY_LARGEST, last);
    const uint i = min(uint(at), BLACKBODY_STEPS - 2u);
    const float fourth = beyond * beyond * beyond * beyond;
    return mix(table.v[i], table.v[i + 1u], at - float(i)) * fourth;
}

// The emission of one volume along a placed ray up to tMax: the sum over a comb of equidistant points, of which `u` says where it
// begins, so that its mean is the integral.
vec3 emissionOfVolume(SceneRecord scene, uint index, Ray ray, float tMax, float u) {
    const FieldRecord glow = VolumeRef(scene.volumes).v[index].glow;
    vec3 sum = vec3(0.0);
    FieldWalk walk;
    if (!beginWalk(glow, ray.origin, ray.direction, ray.tMin, tMax, walk)) return sum;
    const vec3 speed = abs(walk.direction);
    const float rate = COMB_PER_CELL * max(speed.x, max(speed.y, speed.z));
    const bool scaled = (VolumeRef(scene.volumes).v[index].flags & VOLUME_EMISSION_SCALED) != 0u;
    const bool hot = VolumeRef(scene.volumes).v[index].temperature.entries != 0ul;
    walk.left = u;
    [[dont_unroll]] while (nextStop(glow, walk, 0.0, rate) > 0.0) {
        vec3 value = scaled ? interpolateInBrick(glow, walk.entry, stopInBrick(walk)) : vec3(1.0);
        if (hot) {
            const vec3 position = ray.origin + walk.t * ray.direction;
            const float temperature = fieldValue(VolumeRef(scene.volumes).v[index].temperature, position).x;
            value *= blackbodyRadiance(scene, temperature * VolumeRef(scene.volumes).v[index].temperatureScale);
        }
        sum += value;
        walk.left = 1.0;
    }
    return sum / rate * VolumeRef(scene.volumes).v[index].emission;
}

// The emission of all volumes along a ray up to tMax, where its flight ends: a flight comes as far as a point as often as
// light from there would get through, so nothing is attenuated.
vec3 emissionAlong(TraceRecord trace, SceneRecord scene, Path path, Ray ray, float tMax) {
    vec3 sum = vec3(0.0);
    const vec3 inverse = inverseDirection(ray.direction);
    [[dont_unroll]] for (uint k = 0u; k < scene.volumeCount; ++k) {
        if (VolumeRef(scene.volumes).v[k].glow.entries == 0ul) continue;
        if (!meetsVolume(scene.volumes, k, ray.origin, inverse, ray.tMin, tMax)) continue;
        const uint set = hashCombine(VolumeRef(scene.volumes).v[k].seed, 0x80000000u + path.event);
        sum += emissionOfVolume(scene, k, placedRay(scene.volumes, k, ray), tMax, sobol4(path.pixel, path.sampleIndex, set, trace.seed).x);
    }
    return sum;
}
#endif
