// Camera rays.
#ifndef HIPR_TRACE_CAMERA_GLSL
#define HIPR_TRACE_CAMERA_GLSL
#include "trace/lens.glsl"
#include "trace/wavefront.glsl"
#include "accel/motion.glsl"

// The part of a ray from `origin` that the camera sees: between the clipping depths, on the right side of all planes.
Ray seenRay(CameraRef camera, vec3 origin, vec3 direction) {
    const float perDepth = 1.0 / dot(direction, camera.v.forward);
    Ray ray = Ray(origin, camera.v.nearDepth * perDepth, direction, camera.v.farDepth * perDepth, 0.0,
                  RAY_OF_CAMERA);
    for (uint i = 0u; i < camera.v.clipPlaneCount; ++i) {
        const vec4 plane = camera.v.clipPlanes[i];
        const float inside = dot(plane.xyz, origin - camera.v.origin) + plane.w, rate = dot(plane.xyz, direction);
        if (rate > 0.0) ray.tMin = max(ray.tMin, -inside / rate);
        if (rate < 0.0) ray.tMax = min(ray.tMax, -inside / rate);
        if (rate == 0.0 && inside < 0.0) ray.tMax = ray.tMin;
    }
    ray.tMax = max(ray.tMax, ray.tMin); // nothing of it is seen
    return ray;
}

// The ray through the middle of the lens and a point of the film, in pixels from the bottom left corner.
Ray cameraRay(CameraRef camera, vec2 film, uvec2 size) {
    const vec2 ndc = 2.0 * film / vec2(size) - 1.0;
    const vec3 direction = normalize(camera.v.direction + ndc.x * camera.v.directionX + ndc.y * camera.v.directionY);
    return seenRay(camera, camera.v.origin + ndc.x * camera.v.originX + ndc.y * camera.v.originY, direction);
}

// A ray of the camera as it is at the frame's time, taken to where the camera is at the time of the ray.
Ray movedRay(TraceRecord trace, Ray ray) {
    if (trace.cameraKeyCount == 0u) return ray;
    const mat4x3 place = transformAt(trace.cameraKeys, 0u, trace.cameraKeyCount, ray.time);
    const vec3 direction = mat3(place) * ray.direction;
    const float scale = length(direction);
    return Ray(place * vec4(ray.origin - CameraRef(trace.camera).v.origin, 1.0), ray.tMin * scale, direction / scale,
               ray.tMax * scale, ray.time, ray.flags);
}

// The ray of a point of the film through the point of the aperture that u in [0, 1)^2 chooses, all equally likely.
Ray lensRay(CameraRef camera, vec2 film, uvec2 size, vec2 u) {
    const Ray ray = cameraRay(camera, film, size);
    if (camera.v.lensX == vec3(0.0)) return ray;
    const vec2 lens = sampleAperture(camera.v.lensBlades, u);
    const vec3 offset = lens.x * camera.v.lensX + lens.y * camera.v.lensY;
    const vec3 sharp = ray.direction * (camera.v.focusDepth / dot(ray.direction, camera.v.forward));
    return seenRay(camera, ray.origin + offset, normalize(sharp - offset));
}
#endif
