// Light that a ray meets.
#ifndef HIPR_LIGHT_HIT_GLSL
#define HIPR_LIGHT_HIT_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "light/sample.glsl"

// Weight of meeting `light` by a direction drawn with density `bsdfPdf` (negative: by no other way than this ray, as from
// the camera) when sampleLight would have drawn it with density `lightPdf`.
float hitWeight(LightRecord light, float bsdfPdf, float lightPdf) {
    if (bsdfPdf < 0.0) return 1.0;
    return isExclusive(light) ? 0.0 : powerHeuristic(bsdfPdf, lightPdf * light.selectPdf);
}

// Radiance of the area lights between ray.tMin and `tHit`. They are ghosts: all that lie on the way add up. Densities are
// those of sampling from ray.origin: a ray that went straight through surfaces keeps its origin and moves its tMin.
// `categories`: the set of the surface that the ray left; the camera sees all lights.
vec3 lightsAlongRay(SceneRecord scene, Ray ray, float tHit, bool cameraRay, float bsdfPdf, uint categories) {
    vec3 sum = vec3(0.0);
    [[dont_unroll]] for (uint i = 0u; i < scene.areaLightCount; ++i) {
        LightRecord light = LightRef(scene.lights).v[i];
        if (!cameraRay && !inCategory(scene, categories, light.category)) continue;
        LightPoint hit;
        if (!meetLight(light, ray.origin, ray.direction, hit) || hit.t <= ray.tMin || hit.t >= tHit) continue;
        float weight = hitWeight(light, cameraRay ? -1.0 : bsdfPdf, hit.pdf);
        sum += weight * shapeRadiance(scene, light, hit.st, ray.direction);
    }
    return sum;
}

// Radiance of dome and distant lights for a ray that left the scene. Distant lights are not seen by camera rays; domes
// are, unless SCENE_DOME_HIDDEN_FROM_CAMERA.
vec3 environmentRadiance(SceneRecord scene, vec3 direction, bool cameraRay, float bsdfPdf, uint categories) {
    vec3 sum = vec3(0.0);
    bool domes = !(cameraRay && (scene.flags & SCENE_DOME_HIDDEN_FROM_CAMERA) != 0u);
    uint end = scene.areaLightCount + scene.infiniteLightCount;
    [[dont_unroll]] for (uint i = scene.areaLightCount; i < end; ++i) {
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
        sum += hitWeight(light, cameraRay ? -1.0 : bsdfPdf, pdf) * radiance;
    }
    return sum;
}
#endif
