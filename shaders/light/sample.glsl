// Next-event estimation: choosing a light and a direction to it.
#ifndef HIPR_LIGHT_SAMPLE_GLSL
#define HIPR_LIGHT_SAMPLE_GLSL
#include "light/environment.glsl"
#include "light/linking.glsl"
#include "light/mesh.glsl"
#include "light/shaping.glsl"
#include "light/shapes.glsl"
#include "light/tree.glsl"
#include "shared/features.glsl"

struct LightSample {
    vec3 wi;
    float distance;  // INFINITE_DISTANCE for dome and distant lights
    vec3 radiance;   // for directions without a density (of thin lights and a distant one of angle 0) radiance times
                     // solid angle
    float pdf;       // per solid angle, choice of the light included
    vec2 lobeScale;  // the light's diffuse and specular multipliers, for evalBsdfScaled
    uint64_t shadow; // LightRecord::shadow
    Hit end;         // of a mesh: the point, whose emission is not in `radiance`; instance NO_INDEX: another light
    bool dome;
    uint group;      // LightRecord::group
    bool exclusive;  // rays that meet the light do not count it (see isExclusive): the sample has weight 1
};

const float INFINITE_DISTANCE = 3.0e38;

// Lights that only next-event estimation may count: those of no extent, and those whose diffuse and specular
// multipliers are not 1, since a ray that meets a light does not know which lobe it came from.
bool isExclusive(LightRecord light) {
    bool thin = light.kind == LIGHT_THIN || (light.kind == LIGHT_DISTANT && light.area == 0.0);
    return thin || light.diffuse != 1.0 || light.specular != 1.0;
}

vec3 distantAxis(LightRecord light) { return normalize(light.lightToWorld[2]); } // towards the light

// Weight by the power heuristic, exponent 2 (E. Veach, thesis, 1997, section 9.2.4).
float powerHeuristic(float pdf, float other) {
    float ratio = other / pdf;
    return 1.0 / (1.0 + ratio * ratio);
}

// Weight of a light sample against finding the same direction by sampling the BSDF with density `bsdfPdf`.
float lightMisWeight(LightSample ls, float bsdfPdf) { return ls.exclusive ? 1.0 : powerHeuristic(ls.pdf, bsdfPdf); }

// What an area light sends from the point `st`, but for its shaping.
vec3 shapeRadiance(SceneRecord scene, LightRecord light, vec2 st) {
    if (light.texture == NO_INDEX) return light.radiance;
    return light.radiance * max(sampleTexture(TextureRef(scene.textures).v[light.texture], st).rgb, 0.0);
}

// The light for u in [0, 1): by the tree, or in proportion to the chances of lights, the first whose sum of chances is
// above u. `chance` is that of the choice, 0 if it is none.
uint chooseLight(SceneRecord scene, Receiver receiver, float u, out float chance) {
    if (u < scene.lightTreeChance) {
        uint light;
        chance = scene.lightTreeChance * walkLightTree(scene, receiver, NO_INDEX, u / scene.lightTreeChance, light);
        return light;
    }
    FloatRef sums = FloatRef(scene.lightCumulative);
    uint lo = scene.lightTreeChance > 0.0 ? scene.lightCount - scene.infiniteLightCount : 0u;
    uint hi = scene.lightCount - 1u; // the answer is in [lo, hi]
    while (lo < hi) {
        uint middle = (lo + hi) >> 1;
        if (sums.v[middle] > u)
            hi = middle;
        else
            lo = middle + 1u;
    }
    chance = LightRef(scene.lights).v[lo].selectPdf;
    return lo;
}

bool sampleDistant(LightRecord light, vec2 u, inout LightSample ls) {
    vec3 axis = distantAxis(light);
    float x = u.x * light.area / (2.0 * PI); // 1 - cosine
    float sine = sqrt(max(0.0, x * (2.0 - x))), phi = 2.0 * PI * u.y;
    ls.wi = frameAround(axis) * vec3(sine * cos(phi), sine * sin(phi), 1.0 - x);
    ls.radiance = light.radiance;
    ls.pdf = light.area > 0.0 ? 1.0 / light.area : 1.0;
    return true;
}

// A line sends light by the sine of the angle to it, like the cylinder it stands for.
bool sampleThin(LightRecord light, vec3 p, float u, inout LightSample ls) {
    vec3 way = light.lightToWorld * vec4((u - 0.5) * light.size.y, 0.0, 0.0, 1.0) - p;
    float squared = dot(way, way);
    ls.distance = sqrt(squared);
    ls.wi = way / ls.distance;
    ls.pdf = 1.0;
    ls.radiance = light.radiance / squared;
    if (light.size.y > 0.0) ls.radiance *= length(cross(ls.wi, normalize(light.lightToWorld[0])));
    return squared > 0.0;
}

bool sampleEnvironment(SceneRecord scene, LightRecord light, vec2 u, inout LightSample ls) {
    if (light.distribution == 0ul) { // uniform radiance
        float z = 1.0 - 2.0 * u.x, r = sqrt(max(0.0, 1.0 - z * z)), phi = 2.0 * PI * u.y;
        ls.wi = vec3(r * cos(phi), r * sin(phi), z);
        ls.pdf = 1.0 / (4.0 * PI);
        ls.radiance = light.radiance;
        return true;
    }
    vec2 st = sampleDome(light, u, ls.pdf);
    ls.wi = normalize(mat3(light.lightToWorld) * domeDirection(st));
    ls.radiance = domeRadiance(scene, light, st);
    return ls.pdf > 0.0;
}

// Draws one light and a direction from `p` to it; u.x chooses the light, u.yz the direction. `categories`: the set of
// the surface there; `n`: its normal if light reaches it from one side alone, else 0. False: no light, or this one does
// not light it or cannot be seen from `p`.
bool sampleLight(SceneRecord scene, vec3 p, vec3 n, uint categories, vec4 u, out LightSample ls) {
    if (scene.lightCount == 0u) return false;
    float chance;
    uint chosen = chooseLight(scene, Receiver(p, n, categories), u.x, chance);
    if (!(chance > 0.0)) return false;
    LightRecord light = LightRef(scene.lights).v[chosen];
    if (!inCategory(scene, categories, light.category)) return false;
    ls.shadow = light.shadow;
    ls.lobeScale = vec2(light.diffuse, light.specular);
    ls.exclusive = isExclusive(light);
    ls.dome = light.kind == LIGHT_DOME;
    ls.group = light.group;
    ls.distance = INFINITE_DISTANCE;
    ls.end.instance = NO_INDEX;
    bool seen;
    if (light.kind == LIGHT_DOME) {
        seen = sampleEnvironment(scene, light, u.yz, ls);
    } else if (light.kind == LIGHT_DISTANT) {
        seen = sampleDistant(light, u.yz, ls);
    } else if (light.kind == LIGHT_THIN) {
        seen = sampleThin(light, p, u.y, ls);
    } else if (sceneHas(SCENE_HAS_MESH_LIGHTS) && light.kind == LIGHT_MESH) {
        seen = light.distribution != 0ul && sampleMesh(scene, light, p, u.yz, ls.wi, ls.pdf, ls.end);
        ls.distance = ls.end.t;
        ls.radiance = light.radiance;
    } else {
        LightPoint point;
        seen = sampleShape(light, p, u.yz, ls.wi, point);
        ls.distance = point.t;
        ls.pdf = point.pdf;
        ls.radiance = shapeRadiance(scene, light, point.st);
    }
    if (!seen) return false;
    ls.radiance *= shapingFactor(light, ls.wi);
    ls.pdf *= chance;
    return any(greaterThan(ls.radiance, vec3(0.0)));
}
#endif
