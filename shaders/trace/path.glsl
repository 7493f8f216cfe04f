// A path between two of its events, and what kernels that let it go on have in common: its random numbers, the light and
// the medium on its way.
#ifndef HIPR_TRACE_PATH_GLSL
#define HIPR_TRACE_PATH_GLSL
#include "trace/camera.glsl"
#include "sampling/sobol.glsl"
#include "material/medium.glsl"
#include "material/slot.glsl"
#include "trace/lpe_scatter.glsl"

// Lights that a ray meets are sorted one by one: for which path, while they are collected.
uint64_t metRecord = 0ul; // LpeRecord, or 0
uint metSlot;
vec3 metThroughput;

void sortMetLight(LightRecord light, vec3 radiance) {
    if (!sceneHas(FILM_SORTS_LIGHT) || metRecord == 0ul) return;
    const uint kind = light.kind == LIGHT_DOME ? LPE_DOME : LPE_LIGHT;
    addToExpressions(metRecord, metSlot, lightSymbol(LpeRef(metRecord).v, kind, light.group), metThroughput * radiance);
}

#define MET_LIGHT sortMetLight
#include "light/sample.glsl"
#include "light/hit.glsl"

// Random vectors of one event; raygen has set 0.
const uint RANDOM_LIGHT = 1u; // w, which light sampling leaves alone, decides on passing through and on roulette
const uint RANDOM_BSDF = 2u;
const uint RANDOM_SETS = 2u;
// Beside those: one set an event for the length of the flight to it, and one a path for its wavelength.
const uint RANDOM_FLIGHT = 0x10000u;
const uint RANDOM_WAVELENGTH = 0xffffu;

// The part of PathState that a bounce works on.
struct Path {
    uint slot;
    vec3 throughput;
    float bsdfPdf;
    uint event;
    uint depth;
    uvec2 pixel;
    uint sampleIndex;
    uint history;
    uint medium;
    uint mediumColor;
    uint mediumRadius;
    uint categories;
    uint lightNormal;
    uvec2 interiors; // with SCENE_HAS_NESTING
    vec2 cone;
};

Path loadPath(TraceRecord trace, uint slot) {
    PathRef paths = PathRef(trace.paths);
    const uint pixel = paths.v[slot].pixel;
    return Path(slot, paths.v[slot].throughput, paths.v[slot].bsdfPdf, paths.v[slot].event, paths.v[slot].depth,
                uvec2(pixel & 0xffffu, pixel >> 16), paths.v[slot].sampleIndex, paths.v[slot].history,
                paths.v[slot].medium, paths.v[slot].mediumColor, paths.v[slot].mediumRadius,
                paths.v[slot].categories, paths.v[slot].lightNormal,
                sceneHas(SCENE_HAS_NESTING) ? paths.v[slot].interiors : uvec2(0u), paths.v[slot].cone);
}

void storePath(TraceRecord trace, Path path) {
    PathRef paths = PathRef(trace.paths);
    paths.v[path.slot].throughput = path.throughput;
    paths.v[path.slot].bsdfPdf = path.bsdfPdf;
    paths.v[path.slot].event = path.event;
    paths.v[path.slot].depth = path.depth;
    paths.v[path.slot].history = path.history;
    paths.v[path.slot].medium = path.medium;
    paths.v[path.slot].mediumColor = path.mediumColor;
    paths.v[path.slot].mediumRadius = path.mediumRadius;
    paths.v[path.slot].categories = path.categories;
    paths.v[path.slot].lightNormal = path.lightNormal;
    if (sceneHas(SCENE_HAS_NESTING)) paths.v[path.slot].interiors = path.interiors;
    paths.v[path.slot].cone = path.cone;
}

vec4 randomVector(TraceRecord trace, Path path, uint which) {
    return sobol4(path.pixel, path.sampleIndex, RANDOM_SETS * path.event + which, trace.seed);
}

// Whether a path goes on, with the weight of those that do not.
bool survives(inout Path path, float roulette) {
    const float survival = clamp(max(path.throughput.r, max(path.throughput.g, path.throughput.b)), 0.05, 1.0);
    if (roulette >= survival) return false;
    path.throughput /= survival;
    return true;
}

// Whether what the path has met is what its pixel shows, and is to be kept.
bool keepsSeen(TraceRecord trace, Path path) {
    return path.depth == 0u && path.sampleIndex == 0u && trace.seen != 0ul;
}

Ray rayThroughCentre(TraceRecord trace, Path path) {
    return cameraRay(CameraRef(trace.camera), vec2(path.pixel) + 0.5, uvec2(trace.width, trace.height));
}

// The medium a path is in.
MediumRecord mediumOf(SceneRecord scene, Path path) {
    if (!sceneHas(SCENE_HAS_OPENPBR)) return MediumRecord(vec3(0.0), 0.0, vec3(0.0), 0.0);
    const uint kind = path.medium & MEDIUM_KIND, material = (path.medium & ~MEDIUM_DISPERSED) >> MEDIUM_SHIFT;
    MediumRecord medium = MediumRecord(vec3(0.0), 0.0, vec3(0.0), 0.0);
    if (kind == MEDIUM_INTERIOR) medium = MaterialRef(scene.materials).v[material].interior;
    if (kind == MEDIUM_SUBSURFACE) {
        medium = MaterialRef(scene.materials).v[material].subsurface;
        if (medium.extinction == vec3(0.0)) medium.extinction = 1.0 / unpackMediumRadius(path.mediumRadius);
        medium.albedo = scatteringAlbedo(unpackMediumColor(path.mediumColor), medium.anisotropy);
    }
    return medium;
}

// The light a ray has run into by `distance`, and the sky if it met nothing.
void collectLight(TraceRecord trace, SceneRecord scene, Path path, Ray ray, float distance, bool miss) {
    const bool cameraRay = path.depth == 0u;
    if (sortsLight(trace)) metRecord = trace.lpe, metSlot = path.slot, metThroughput = path.throughput;
    vec3 light = lightsAlongRay(scene, ray, distance, cameraRay, path.bsdfPdf,
                                unpackLightNormal(path.lightNormal), path.categories);
    if (cameraRay && any(greaterThan(light, vec3(0.0)))) PathRef(trace.paths).v[path.slot].alpha = 1.0;
    if (miss) light += environmentRadiance(scene, ray.direction, cameraRay, path.bsdfPdf, path.categories);
    addRadiance(trace, path.slot, path.throughput * light, path.depth > 1u);
}

// Adds what something in the scene that emits brings to a path; `group`: its light group.
void collectEmission(TraceRecord trace, Path path, vec3 value, uint group) {
    addRadiance(trace, path.slot, value, path.depth > 1u);
    if (!sortsLight(trace)) return;
    addToExpressions(trace.lpe, path.slot, lightSymbol(LpeRef(trace.lpe).v, LPE_OBJECT, group), value);
}

// Sorts a path's shadow ray towards a light by what scatters it: an event, or LPE_BY_LOBES.
void sortShadow(TraceRecord trace, SceneRecord scene, Path path, LightSample light, LobeShares lobes, uint event) {
    if (!sortsLight(trace)) return;
    const bool object = light.end.instance != NO_INDEX;
    const uint kind = object ? LPE_OBJECT : light.dome ? LPE_DOME : LPE_LIGHT;
    uint group = light.group;
    if (object) group = lightGroupAt(scene, light.end);
    shadowInExpressions(trace.lpe, path.slot, lobes, event, lightSymbol(LpeRef(trace.lpe).v, kind, group));
}

// The same of a path that goes on.
void sortScattered(TraceRecord trace, Path path, LobeShares lobes, uint event) {
    if (!sortsLight(trace) || event == LPE_NO_EVENT) return;
    const uint random = hashCombine(hashCombine(path.pixel.x | path.pixel.y << 16, path.sampleIndex), path.event);
    goOnInExpressions(trace.lpe, path.slot, lobes, event, random);
}

// Lets a scattering medium end the path's next flight. False: nothing is left of the path.
bool extendFlight(TraceRecord trace, SceneRecord scene, Path path, inout Ray ray) {
    const MediumRecord medium = mediumOf(scene, path);
    if (medium.albedo == vec3(0.0)) return true;
    const float u = sobol4(path.pixel, path.sampleIndex, RANDOM_FLIGHT + path.event, trace.seed).x;
    ray.tMax = ray.tMin + sampleFlight(medium, path.throughput, u);
    return any(greaterThan(path.throughput, vec3(0.0)));
}

// Hands a path on to the next round.
void sendOn(TraceRecord trace, Path path, Ray ray) {
    storePath(trace, path);
    const uint other = 1u - push.turn;
    const uint j = appendToQueue(trace, QUEUE_RAYS + other);
    RayRef(trace.rays[other]).v[j] = ray;
    SlotRef(trace.raySlots[other]).v[j] = path.slot;
}
#endif
