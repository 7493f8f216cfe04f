// Splats sorted by where rays meet them (L. Radl et al., "StopThePop", SIGGRAPH 2024), once a tile.
#ifndef HIPR_HIGS_RAY_HIT_GLSL
#define HIPR_HIGS_RAY_HIT_GLSL
#include "higs/frame.glsl"

// Distance at which the ray through the middle of a tile meets the largest density of a splat.
float rayHitDistance(SplatFrame frame, uint tile, uint splat) {
    const CameraRecord camera = CameraRef(frame.camera).v;
    const vec2 size = vec2(frame.tileWidth, frame.tileHeight);
    const vec2 middle = (vec2(tile % frame.tileColumns, tile / frame.tileColumns) + 0.5) * size;
    const vec2 ndc = 2.0 * middle / vec2(frame.width, frame.height) - 1.0;
    const vec3 d = normalize(camera.direction + ndc.x * camera.directionX + ndc.y * camera.directionY);
    const vec3 o = ndc.x * camera.originX + ndc.y * camera.originY;
    const SplatRay ray = RayRef(frame.rays).v[splat];
    const vec3 md = vec3(dot(vec3(ray.diagonal.x, ray.other.xy), d),
                         dot(vec3(ray.other.x, ray.diagonal.y, ray.other.z), d),
                         dot(vec3(ray.other.yz, ray.diagonal.z), d));
    return max((dot(d, ray.pull) - dot(md, o)) / dot(d, md), 0.0);
}
#endif
