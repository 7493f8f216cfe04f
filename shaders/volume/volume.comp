// The way of each ray through the volumes of the scene, up to what it has hit: collects what they emit, and scatters the
// path where one of them does. Between `nearest` and `shade`, which leaves paths that were scattered alone.
//
// Every volume is walked through by itself with random numbers of its own (delta tracking: E. Woodcock et al., 1965); the
// first collision of all counts. Since flights are exponential this is the flight through the sum of the volumes, and the
// volume that ends it is drawn as its share there demands. Where extinction depends on the colour, its largest channel
// decides on collisions, and what the others do not take goes on: P. Kutz et al., "Spectral and Decomposition Tracking for
// Rendering Heterogeneous Volumes", 2017.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/path.glsl"
#include "volume/emission.glsl"
#include "volume/phase.glsl"
#include "shared/reproject.h"

// A random number of one flight through one volume, stratified over the samples of a pixel; `random` gets further ones.
float flightNumber(TraceRecord trace, Path path, uint seed, out uint random) {
    const uint set = hashCombine(seed, 2u * path.event);
    const vec4 u = sobol4(path.pixel, path.sampleIndex, set, trace.seed);
    random = floatBitsToUint(u.y) ^ hashUint(path.pixel.x | path.pixel.y << 16) ^ set;
    return u.x;
}

// Where a placed ray collides with a volume before tMax, or tMax.
float collide(TraceRecord trace, SceneRecord scene, Path path, Ray ray, uint index, float tMax) {
    const FieldRecord density = VolumeRef(scene.volumes).v[index].density;
    const float densest = VolumeRef(scene.volumes).v[index].densest;
    FieldWalk walk;
    if (!beginWalk(density, ray.origin, ray.direction, ray.tMin, tMax, walk)) return tMax;
    uint random;
    walk.left = exponential(flightNumber(trace, path, VolumeRef(scene.volumes).v[index].seed, random));
    [[dont_unroll]] while (true) {
        const float rate = nextStop(density, walk, densest, 0.0);
        if (rate == 0.0) return tMax;
        if (nextRandom(random) * rate < densityAtStop(density, walk) * densest) return walk.t;
        walk.left = exponential(nextRandom(random));
    }
    return tMax;
}

// The first collision of a ray with any volume before tMax. Returns its distance; `met` is NO_INDEX if there is none.
float firstCollision(TraceRecord trace, SceneRecord scene, Path path, Ray ray, float tMax, out uint met) {
    const vec3 inverse = inverseDirection(ray.direction);
    met = NO_INDEX;
    [[dont_unroll]] for (uint k = 0u; k < scene.volumeCount; ++k) {
        if (!meetsVolume(scene.volumes, k, ray.origin, inverse, ray.tMin, tMax)) continue;
        const float t = collide(trace, scene, path, placedRay(scene.volumes, k, ray), k, tMax);
        if (t < tMax) tMax = t, met = k;
    }
    return tMax;
}

// Next event estimation at a point of a volume.
void sampleVolumeLight(TraceRecord trace, SceneRecord scene, Path path, vec3 position, vec3 direction, float time,
                       float anisotropy) {
    LightSample light;
    const vec4 u = randomVector(trace, path, RANDOM_LIGHT);
    if (!sampleLight(scene, position, vec3(0.0), path.categories, u, light)) return;
    const float phase = phaseDensity(dot(direction, light.wi), anisotropy);
    const vec3 contribution = path.throughput * phase * light.lobeScale.x * light.radiance / light.pdf;
    if (contribution == vec3(0.0)) return;
    // Surfaces that emit are found through homogeneous media by the path alone, as in shade.comp.
    if (light.end.instance != NO_INDEX && (path.medium & MEDIUM_KIND) != MEDIUM_NONE) return;
    const uint i = appendToQueue(trace, QUEUE_SHADOW + push.turn);
    RayRef(trace.shadowRays).v[i] = Ray(position, 0.0, light.wi, light.distance * (1.0 - 1e-4), time, 0u);
    ShadowWorkRef(trace.shadowWork).v[i] =
        ShadowWork(contribution, path.depth > 1u ? path.slot | SHADOW_INDIRECT : path.slot, light.shadow,
                   lightMisWeight(light, phase), path.event);
    sortShadow(trace, scene, path, light, noLobes(), LPE_VOLUME);
    if (scene.instanceLights != 0ul) HitRef(trace.shadowEnds).v[i] = light.end;
}

// What the pixel shows if its path was stopped at once.
void keepSeenVolume(TraceRecord trace, Path path, vec3 position, vec3 albedo) {
    PathRef(trace.paths).v[path.slot].alpha = 1.0;
    PathRef(trace.paths).v[path.slot].albedo = albedo;
    if (!keepsSeen(trace, path)) return;
    const Ray centre = rayThroughCentre(trace, path);
    const vec3 forward = CameraRef(trace.camera).v.forward;
    const float level = dot(position - centre.origin, forward) / dot(centre.direction, forward);
    PathSeenRef(trace.pathSeen).v[path.slot] =
        SeenPoint(centre.origin + level * centre.direction, packLook(0.0, 1.0, 0.0));
}

// What a volume does with a path at a collision. False: the path ends here.
bool scatterInVolume(TraceRecord trace, SceneRecord scene, inout Path path, inout Ray ray, uint index, float t) {
    const vec3 position = ray.origin + t * ray.direction;
    const float densest = VolumeRef(scene.volumes).v[index].densest;
    vec3 scattered = VolumeRef(scene.volumes).v[index].scattering / densest;
    const vec3 passed = 1.0 - VolumeRef(scene.volumes).v[index].extinction / densest;
    if (VolumeRef(scene.volumes).v[index].color.entries != 0ul) {
        const Ray placed = placedRay(scene.volumes, index, ray);
        scattered *= min(fieldValue(VolumeRef(scene.volumes).v[index].color, placed.origin + t * placed.direction), 1.0);
    }
    const vec4 u = randomVector(trace, path, RANDOM_BSDF);
    const float on = dot(path.throughput, passed), share = dot(path.throughput, scattered) + on;
    if (path.event - path.depth >= MEDIUM_STEP_LIMIT) return false;
    if (u.w * share < on) {
        path.throughput *= passed * (share / on);
        ++path.event;
        ray.tMin = t;
        return true;
    }
    if (path.depth == 0u) keepSeenVolume(trace, path, position, scattered);
    if (path.depth >= trace.maxDepth) return false;
    path.throughput *= scattered * (share / max(share - on, 1e-30));
    if (path.throughput == vec3(0.0)) return false;
    path.categories = VolumeRef(scene.volumes).v[index].categories;
    path.lightNormal = 0u;
    const float anisotropy = VolumeRef(scene.volumes).v[index].anisotropy;
    sampleVolumeLight(trace, scene, path, position, ray.direction, ray.time, anisotropy);
    if (!survives(path, u.z)) return false;
    const vec3 wi = samplePhase(ray.direction, anisotropy, u.xy);
    path.bsdfPdf = phaseDensity(dot(ray.direction, wi), anisotropy);
    path.history = extendHistory(path.history, SCATTER_DIFFUSE, path.depth);
    if (path.depth == 0u) path.depth = 1u;
    ++path.event;
    sortScattered(trace, path, noLobes(), LPE_VOLUME);
    ray = Ray(position, 0.0, wi, RAY_INFINITY, ray.time, 0u);
    return allFinite(path.throughput);
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_RAYS + push.turn].count) return;
    const SceneRecord scene = SceneRef(trace.scene).v;
    Ray ray = RayRef(trace.rays[push.turn]).v[i];
    Path path = loadPath(trace, SlotRef(trace.raySlots[push.turn]).v[i]);
    uint met;
    const float t = firstCollision(trace, scene, path, ray, HitRef(trace.hits).v[i].t, met);
    collectEmission(trace, path, path.throughput * emissionAlong(trace, scene, path, ray, t), NO_INDEX);
    if (met == NO_INDEX) return;
    HitRef(trace.hits).v[i] = Hit(NO_INDEX, HIT_TAKEN, t, 0.0, 0.0);
    collectLight(trace, scene, path, ray, t, false);
    const MediumRecord medium = mediumOf(scene, path);
    if (medium.extinction != vec3(0.0)) path.throughput *= flightWeight(medium, path.throughput, t - ray.tMin, false);
    if (!scatterInVolume(trace, scene, path, ray, met, t) || !extendFlight(trace, scene, path, ray)) return;
    sendOn(trace, path, ray);
}
