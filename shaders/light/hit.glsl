// Light that a ray meets.
#ifndef HIPR_LIGHT_HIT_GLSL
#define HIPR_LIGHT_HIT_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "light/sample.glsl"

// Told of each light and of the radiance that it adds, where a kernel wants to know.
#ifndef MET_LIGHT
#define MET_LIGHT(light, radiance)
#endif

// Weight of meeting `light` by a direction drawn with density `bsdfPdf` (negative: by no other way than this ray, as from
// the camera) when light sampling would have drawn it with density `lightPdf`.
float hitWeight(LightRecord light, float bsdfPdf, float lightPdf) {
    if (bsdfPdf < 0.0) return 1.0;
    return isExclusive(light) ? 0.0 : powerHeuristic(bsdfPdf, lightPdf);
}

// Whether the part of a ray from tMin to tHit comes through a box. Boxes are a little larger than what is in them.
bool meetsLightBox(LightNode node, vec3 origin, vec3 inverse, float tMin, float tHit) {
    vec3 a = (node.lo - origin) * inverse, b = (node.hi - origin) * inverse;
    vec3 near = min(a, b), far = max(a, b);
    return max(max(near.x, near.y), max(near.z, tMin)) <= min(min(far.x, far.y), min(far.z, tHit));
}

// Radiance of the area lights between ray.tMin and `tHit`. They are ghosts: all that lie on the way add up. Densities are
// those of sampling from ray.origin: a ray that went straight through surfaces keeps its origin and moves its tMin.
// `n` and `categories`: those of the surface that the ray left, as for sampleLight; the camera sees all lights.
vec3 lightsAlongRay(SceneRecord scene, Ray ray, float tHit, bool cameraRay, float bsdfPdf, vec3 n, uint categories) {
    vec3 sum = vec3(0.0);
    if (scene.areaLightCount == 0u) return sum;
    LightNodeRef nodes = LightNodeRef(scene.lightNodes);
    vec3 d = ray.direction;
    vec3 inverse = 1.0 / mix(d, vec3(1e-20), lessThan(abs(d), vec3(1e-20)));
    uint i = 0u;
    [[dont_unroll]] while (i < scene.lightNodeCount) {
        LightNode node = nodes.v[i];
        bool leaf = node.light != NO_INDEX, met = meetsLightBox(node, ray.origin, inverse, ray.tMin, tHit);
        i = met ? i + 1u : node.next;
        if (!leaf || !met || node.light >= scene.areaLightCount) continue;
        LightRecord light = LightRef(scene.lights).v[node.light];
        if (!cameraRay && !inCategory(scene, categories, light.category)) continue;
        LightPoint hit;
        if (!meetLight(light, ray.origin, d, hit) || hit.t <= ray.tMin || hit.t >= tHit) continue;
        float pdf = cameraRay || bsdfPdf < 0.0 ? 0.0 : hit.pdf * lightChance(scene, light, Receiver(ray.origin, n, categories));
        const vec3 radiance = hitWeight(light, cameraRay ? -1.0 : bsdfPdf, pdf) * shapeRadiance(scene, light, hit.st) *
                              shapingFactor(light, d);
        MET_LIGHT(light, radiance);
        sum += radiance;
    }
    return sum;
}

// What counts of the emission of a surface that a ray has met: weight, as hitWeight(), and shaping. `n`, `categories`: of
// the surface that the ray left; the camera sees all.
vec3 emissionShare(SceneRecord scene, Hit hit, Ray ray, bool cameraRay, float bsdfPdf, vec3 n, uint categories) {
    if (!sceneHas(SCENE_HAS_MESH_LIGHTS) || scene.instanceLights == 0ul) return vec3(1.0);
    uint index = UintRef(scene.instanceLights).v[hit.instance];
    if (index == NO_INDEX) return vec3(1.0);
    LightRecord light = LightRef(scene.lights).v[index];
    if (!cameraRay && !inCategory(scene, categories, light.category)) return vec3(0.0);
    float pdf = bsdfPdf < 0.0 || light.distribution == 0ul
                    ? 0.0
                    : meshPdf(scene, light, hit, ray.direction) * lightChance(scene, light, Receiver(ray.origin, n, categories));
    return hitWeight(light, bsdfPdf, pdf) * shapingFactor(light, ray.direction);
}

// Radiance of dome and distant lights for a ray that left the scene. Distant lights are not seen by camera rays; domes
// are, unless SCENE_DOME_HIDDEN_FROM_CAMERA.
vec3 environmentRadiance(SceneRecord scene, vec3 direction, bool cameraRay, float bsdfPdf, uint categories) {
    vec3 sum = vec3(0.0);
    bool domes = !(cameraRay && (scene.flags & SCENE_DOME_HIDDEN_FROM_CAMERA) != 0u);
    [[dont_unroll]] for (uint i = scene.lightCount - scene.infiniteLightCount; i < scene.lightCount; ++i) {
        LightRecord light = LightRef(scene.lights).v[i];
        if (!cameraRay && !inCategory(scene, categories, light.category)) continue;
        vec3 radiance = vec3(0.0);
        float pdf = 1.0;
        if (light.kind == LIGHT_DISTANT) {
            vec3 off = direction - distantAxis(light); // |off|^2 / 2 = 1 - cosine, without cancellation
            bool inside = dot(off, off) <= light.area / PI && light.area > 0.0;
            if (inside && !cameraRay) radiance = light.radiance * shapingFactor(light, direction), pdf = 1.0 / light.area;
        } else if (domes) {
            vec2 st = domeCoordinates(mat3(light.worldToLight) * direction);
            radiance = domeRadiance(scene, light, st);
            pdf = light.distribution == 0ul ? 1.0 / (4.0 * PI) : domePdf(light, st);
        }
        radiance *= hitWeight(light, cameraRay ? -1.0 : bsdfPdf, pdf * light.selectPdf);
        MET_LIGHT(light, radiance);
        sum += radiance;
    }
    return sum;
}
#endif
