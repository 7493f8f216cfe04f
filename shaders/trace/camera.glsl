// Camera rays.
#ifndef HIPR_TRACE_CAMERA_GLSL
#define HIPR_TRACE_CAMERA_GLSL
#include "trace/wavefront.glsl"

// The ray through a point of the film, in pixels from the bottom left corner.
Ray cameraRay(CameraRecord camera, vec2 film, uvec2 size) {
    const vec2 ndc = 2.0 * film / vec2(size) - 1.0;
    const vec3 direction = normalize(camera.direction + ndc.x * camera.directionX + ndc.y * camera.directionY);
    const float perDepth = 1.0 / dot(direction, camera.forward);
    const vec3 origin = camera.origin + ndc.x * camera.originX + ndc.y * camera.originY;
    return Ray(origin, camera.nearDepth * perDepth, direction, camera.farDepth * perDepth);
}
#endif
