// One bounce of each path in flight: collects the light its ray ran into, then lets the surface scatter it. A light
// sample goes to the shadow queue, the continued path to the other ray queue.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/cone.glsl"
#include "trace/offset.glsl"
#include "trace/path.glsl"
#include "material/surface.glsl"
#include "material/bsdf.glsl"
#include "shared/reproject.h"
#include "shared/volume.h"

// How far, as a share of the depth, the plane of a surface is followed to the pixel's centre.
const float PLANE_REACH = 0.05;

vec3 offsetTowards(Surface surface, vec3 direction) {
    return offsetOrigin(surface.position, dot(surface.ng, direction) < 0.0 ? -surface.ng : surface.ng, surface.restless);
}

// Whether a path that goes on in the direction `wi` is in no medium then. Surfaces that emit are found through media by the
// path itself alone: light samples know nothing of what a medium takes away.
bool goesFree(Path path, Surface surface, vec3 wi) {
    if (!surface.openPbr || surface.thinWalled || dot(wi, surface.ng) >= 0.0)
        return (path.medium & MEDIUM_KIND) == MEDIUM_NONE;
    return surface.inside && surface.around == NO_INDEX;
}

// Whether a surface is the way out of the medium below it that a path is in: the walk there was one event.
bool leavesSubsurface(Path path, Surface surface) {
    return !surface.frontFacing &&
           (path.medium & ~MEDIUM_DISPERSED) == (surface.material << MEDIUM_SHIFT | MEDIUM_SUBSURFACE);
}

// Next event estimation: the light of one emitter, to be weighted against finding it by BSDF sampling.
void sampleDirectLight(TraceRecord trace, SceneRecord scene, Path path, Surface surface, vec3 wo, vec4 u, float time) {
    LightSample light;
    const vec3 n = unpackLightNormal(path.lightNormal); // as rays that meet the light will have it
    if (!sampleLight(scene, surface.position, n, path.categories, u, light)) return;
    float bsdfPdf;
    const vec3 f = evalBsdfScaled(surface, wo, light.wi, light.lobeScale, bsdfPdf);
    const vec3 contribution = path.throughput * f * light.radiance / light.pdf;
    if (contribution == vec3(0.0)) return;
    if (light.end.instance != NO_INDEX && !goesFree(path, surface, light.wi)) return;
    const uint i = appendToQueue(trace, QUEUE_SHADOW + push.turn);
    RayRef(trace.shadowRays).v[i] =
        Ray(offsetTowards(surface, light.wi), 0.0, light.wi, light.distance * (1.0 - 1e-4), time, 0u);
    ShadowWorkRef(trace.shadowWork).v[i] =
        ShadowWork(contribution, path.depth > 0u ? path.slot | SHADOW_INDIRECT : path.slot, light.shadow,
                   lightMisWeight(light, bsdfPdf), path.event);
    sortShadow(trace, scene, path, light, lobeShares, leavesSubsurface(path, surface) ? LPE_NO_EVENT : LPE_BY_LOBES);
    if (scene.instanceLights != 0ul) HitRef(trace.shadowEnds).v[i] = light.end;
}

// What kind of scattering a lobe (LOBE_*) did towards `wi`, for discovery.
uint scatterKind(Surface surface, uint lobe, vec3 wi) {
    if (lobe == LOBE_DIFFUSE || lobe == LOBE_FUZZ) return SCATTER_DIFFUSE;
    if (lobe >= LOBE_GLASS && dot(surface.ng, wi) < 0.0) return SCATTER_TRANSMISSION;
    const float roughness = lobe == LOBE_COAT ? surface.coatRoughness : surface.roughness;
    return roughness < SPECULAR_ROUGHNESS ? SCATTER_SPECULAR : SCATTER_GLOSSY;
}

// What the path travels through after a lobe has sent it towards `wi`.
void enterMedium(inout Path path, Surface surface, uint lobe, vec3 wi) {
    if (!surface.openPbr || surface.thinWalled || dot(wi, surface.ng) >= 0.0) return;
    const bool below = lobe == LOBE_SUBSURFACE;
    if (below) {
        path.mediumColor = packMediumColor(surface.subsurfaceColor);
        path.mediumRadius = packMediumRadius(surface.subsurfaceRadius);
    }
    const uint entered = surface.inside && !below ? surface.around : surface.material;
    path.medium &= MEDIUM_DISPERSED;
    if (entered != NO_INDEX) path.medium |= entered << MEDIUM_SHIFT | (below ? MEDIUM_SUBSURFACE : MEDIUM_INTERIOR);
    if (sceneHas(SCENE_HAS_NESTING) && !below && surface.glass > 0.0)
        path.interiors = crossedInteriors(path.interiors, surface.material, surface.frontFacing);
}

// Lets a path go straight on behind a surface. False: it ends here.
bool passSurface(inout Path path, inout Ray ray, Hit hit) {
    if (path.event - path.depth >= PATH_PASS_LIMIT) return false;
    ++path.event;
    ray.tMin = passedDistance(hit.t);
    return true;
}

// Samples the next direction. False: the path ends here.
bool bounce(TraceRecord trace, inout Path path, inout Ray ray, Surface surface, vec3 wo, float roulette) {
    vec3 wi, weight;
    float pdf;
    uint lobe;
    if (!sampleBsdf(surface, wo, randomVector(trace, path, RANDOM_BSDF), wi, weight, pdf, lobe)) return false;
    path.throughput *= weight;
    path.bsdfPdf = pdf;
    path.cone = scatteredCone(path.cone, pdf);
    path.history = extendHistory(path.history, scatterKind(surface, lobe, wi), path.depth);
    ++path.depth;
    ++path.event;
    if (path.depth >= trace.rouletteDepth && !survives(path, roulette)) return false;
    sortScattered(trace, path, lobeShares,
                  leavesSubsurface(path, surface) ? LPE_NO_EVENT
                                                  : lobe == LOBE_SUBSURFACE ? LPE_SUBSURFACE : LPE_BY_LOBES);
    enterMedium(path, surface, lobe, wi);
    ray = Ray(offsetTowards(surface, wi), 0.0, wi, RAY_INFINITY, ray.time, 0u);
    return any(greaterThan(path.throughput, vec3(0.0))) && allFinite(path.throughput);
}

// The sample lies somewhere around the pixel's centre: what shows there is the surface, continued as a plane. Where that
// leads far away, as at silhouettes, the point at the same depth.
void keepSeenSurface(TraceRecord trace, Path path, Surface surface, float time) {
    const Ray centre = rayThroughCentre(trace, path); // of the camera that a move starts from
    Ray then = centre;
    then.time = time;
    then = movedRay(trace, then);
    const vec3 way = surface.position - then.origin;
    vec3 forward = CameraRef(trace.camera).v.forward;
    if (trace.cameraKeyCount > 0u)
        forward = mat3(transformAt(trace.cameraKeys, 0u, trace.cameraKeyCount, time)) * forward;
    const float level = dot(way, forward) / dot(then.direction, forward);
    const float onPlane = dot(way, surface.ng) / dot(then.direction, surface.ng);
    const float distance_ = abs(onPlane - level) <= PLANE_REACH * level ? onPlane : level;
    const float coat = surface.lobeChance.x, other = surface.lobeChance.y + surface.lobeChance.w, share = coat + other;
    const vec2 alphas = (coat * surface.coatAlpha + other * surface.alpha) / max(share, 1e-6);
    const float alpha = 0.5 * (alphas.x + alphas.y);
    const float scattered = luminance(surface.albedo), emitted = luminance(surface.emission);
    PathSeenRef(trace.pathSeen).v[path.slot] =
        SeenPoint(centre.origin + distance_ * centre.direction,
                  packLook(share * scattered / max(scattered + emitted, 1e-6), alpha, 0.0));
}

// Scatters a path in the medium it is in, at the end of its flight. False: the path ends here.
bool scatterInMedium(TraceRecord trace, MediumRecord medium, inout Path path, inout Ray ray) {
    if (path.depth >= trace.maxDepth || path.event - path.depth >= MEDIUM_STEP_LIMIT) return false;
    path.cone = flownCone(path.cone, ray.tMax);
    const vec4 u = randomVector(trace, path, RANDOM_BSDF);
    if (!survives(path, u.z)) return false;
    ++path.event;
    const vec3 direction = samplePhase(ray.direction, medium.anisotropy, u.xy);
    if ((path.medium & MEDIUM_KIND) == MEDIUM_INTERIOR) sortScattered(trace, path, lobeShares, LPE_VOLUME);
    ray = Ray(ray.origin + ray.direction * ray.tMax, 0.0, direction, RAY_INFINITY, ray.time, 0u);
    path.bsdfPdf = -1.0; // no light was sampled here
    path.cone = scatteredCone(path.cone, -1.0);
    return true;
}

// Where the index of refraction depends on the wavelength a path has one, and its colour.
void disperse(TraceRecord trace, SceneRecord scene, inout Path path, inout Surface surface) {
    const float abbe = MaterialRef(scene.materials).v[surface.material].interior.dispersion;
    if (!surface.openPbr || surface.glass == 0.0 || surface.thinWalled || abbe == 0.0) return;
    vec3 color;
    const float u = sobol4(path.pixel, path.sampleIndex, RANDOM_WAVELENGTH, trace.seed).x;
    const float wavelength = sampleWavelength(u, color);
    const float around = surface.aroundIor, mean = around * (surface.inside ? 1.0 / surface.eta : surface.eta);
    const float index = usableIor(dispersedIndex(mean, abbe, wavelength) / around);
    surface.eta = surface.inside ? 1.0 / index : index;
    if ((path.medium & MEDIUM_DISPERSED) == 0u) path.throughput *= color;
    path.medium |= MEDIUM_DISPERSED;
}

// Adds what a surface emits towards a path that met it.
void addEmission(TraceRecord trace, SceneRecord scene, Path path, Ray ray, Hit hit, vec3 emission) {
    if (emission == vec3(0.0)) return;
    const float bsdfPdf = (path.medium & MEDIUM_KIND) == MEDIUM_NONE ? path.bsdfPdf : -1.0; // see goesFree()
    const vec3 share = emissionShare(scene, hit, ray, path.depth == 0u, bsdfPdf, unpackLightNormal(path.lightNormal),
                                     path.categories);
    const uint group = sortsLight(trace) ? lightGroupAt(scene, hit) : NO_INDEX;
    collectEmission(trace, path, path.throughput * emission * share, group);
}

// What a path covers where it hits. The last digits of a random number choose between levels: its first ones, which choose
// a place on a light, say nothing about them.
RayFootprint footprintOf(TraceRecord trace, Path path, float distance_, float u) {
    if (trace.filtersTextures == 0u) return NO_FOOTPRINT;
    const float width = abs(flownCone(path.cone, distance_).x) * coneOfSample(trace, path.sampleIndex);
    return RayFootprint(width, fract(u * 4096.0), path.depth > 0u);
}

// What a surface does with a path. False: the path ends here.
bool scatter(TraceRecord trace, SceneRecord scene, inout Path path, inout Ray ray, Hit hit) {
    const vec4 u = randomVector(trace, path, RANDOM_LIGHT);
    Surface surface = evaluateSurface(scene, hit, ray, footprintOf(trace, path, hit.t, u.y), path.interiors);
    if (sceneHas(SCENE_HAS_NESTING) && surface.hidden) {
        path.interiors = crossedInteriors(path.interiors, surface.material, surface.frontFacing);
        return passSurface(path, ray, hit);
    }
    if (leavesSubsurface(path, surface)) setSubsurfaceExit(surface);
    if (u.w >= surface.opacity) return passSurface(path, ray, hit);
    if (path.depth == 0u) {
        PathRef(trace.paths).v[path.slot].alpha = 1.0;
        PathRef(trace.paths).v[path.slot].albedo = surface.albedo;
        if (keepsSeen(trace, path)) keepSeenSurface(trace, path, surface, ray.time);
        if (trace.pathSlots != 0ul) SlotRef(trace.pathSlots).v[path.slot] = slotAt(scene, hit);
    }
    addEmission(trace, scene, path, ray, hit, surface.emission);
    if (path.depth >= trace.maxDepth) return false;
    path.cone = flownCone(path.cone, hit.t);
    disperse(trace, scene, path, surface);
    path.categories = InstanceRef(scene.instances).v[hit.instance].categories;
    path.lightNormal = surface.openPbr || surface.glass > 0.0 ? 0u : packLightNormal(surface.ng);
    const vec3 wo = -ray.direction;
    sampleDirectLight(trace, scene, path, surface, wo, u, ray.time);
    return bounce(trace, path, ray, surface, wo, u.w / surface.opacity); // uniform again
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_RAYS + push.turn].count) return;
    const SceneRecord scene = SceneRef(trace.scene).v;
    const Hit hit = HitRef(trace.hits).v[i];
    if (hit.primitive == HIT_TAKEN) return;
    Ray ray = RayRef(trace.rays[push.turn]).v[i];
    Path path = loadPath(trace, SlotRef(trace.raySlots[push.turn]).v[i]);

    // Camera rays end at the far plane, later ones only where a medium scatters the path.
    const bool nothing = hit.instance == NO_INDEX;
    const bool inMedium = sceneHas(SCENE_HAS_OPENPBR) && nothing && path.depth > 0u && ray.tMax < RAY_INFINITY, miss = nothing && !inMedium;
    const float distance_ = nothing ? ray.tMax : hit.t;
    collectLight(trace, scene, path, ray, distance_, miss);
    const MediumRecord medium = mediumOf(scene, path);
    if (medium.extinction != vec3(0.0))
        path.throughput *= flightWeight(medium, path.throughput, distance_ - ray.tMin, inMedium);
    if (miss && keepsSeen(trace, path))
        PathSeenRef(trace.pathSeen).v[path.slot] = SeenPoint(rayThroughCentre(trace, path).direction, SEEN_SKY);
    if (miss || !(inMedium ? scatterInMedium(trace, medium, path, ray) : scatter(trace, scene, path, ray, hit))) return;
    if (!extendFlight(trace, scene, path, ray)) return;
    sendOn(trace, path, ray);
}
