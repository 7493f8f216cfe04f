// How far what a pixel sees moves on the film.
#ifndef HIPR_FILM_MOTION_VECTOR_GLSL
#define HIPR_FILM_MOTION_VECTOR_GLSL
#include "trace/camera.glsl"
#include "material/point.glsl"

// Where a point in world space is on the film at a time of the shutter, in pixels from the bottom left corner.
vec2 filmPoint(TraceRecord trace, vec3 p, float time) {
    const CameraRecord camera = CameraRef(trace.camera).v;
    if (trace.cameraKeyCount > 0u) {
        const mat4x3 place = transformAt(trace.cameraKeys, 0u, trace.cameraKeyCount, time); // see movedRay()
        p = camera.origin + inverseTransform(place) * vec4(p, 1.0);
    }
    const vec4 clip = camera.worldToClip * vec4(p, 1.0);
    return (0.5 * clip.xy / clip.w + 0.5) * vec2(trace.width, trace.height);
}

// Where the point of the surface that was hit is at a time of the shutter.
vec3 placeAt(SceneRecord scene, Hit hit, float time) {
    ShadingPoint point = shadingPoint(scene, hit);
    moveTo(point, scene, time);
    return point.instance.objectToWorld * vec4(surfaceAt(point).position, 1.0);
}

// From where it is when the shutter opens to where it is when it closes, in pixels, x to the right and y up.
vec2 motionVector(TraceRecord trace, SceneRecord scene, Hit hit) {
    if (trace.moving == 0u) return vec2(0.0);
    return filmPoint(trace, placeAt(scene, hit, 1.0), 1.0) - filmPoint(trace, placeAt(scene, hit, 0.0), 0.0);
}
#endif
