// What the ray through each pixel's centre sees first, and the AOVs that follow from it. Surfaces that are cut out
// (opacity 0) are not seen: their rays go on in the other queue.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "film/motion_vector.glsl"
#include "trace/wavefront.glsl"
#include "material/surface.glsl"
#include "material/presence.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer WordRef { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer DepthRef { float v[]; };

void store(AovTarget target, uint pixel, float value) {
    WordRef(target.values).v[pixel] = floatBitsToUint(value);
}

void store(AovTarget target, uint pixel, int value) {
    WordRef(target.values).v[pixel] = uint(value);
}

void store(AovTarget target, uint pixel, vec2 value) {
    for (uint k = 0u; k < 2u; ++k)
        WordRef(target.values).v[2u * pixel + k] = floatBitsToUint(value[k]);
}

void store(AovTarget target, uint pixel, vec3 value) {
    for (uint k = 0u; k < 3u; ++k)
        WordRef(target.values).v[3u * pixel + k] = floatBitsToUint(value[k]);
}

void storeAov(TraceRecord trace, AovTarget target, uint pixel, bool seen, ShadingPoint point, vec3 position, vec3 normal) {
    const CameraRecord camera = CameraRef(trace.camera).v;
    switch (target.kind) {
    case AOV_DEPTH: {
        const vec4 clip = camera.worldToClip * vec4(position, 1.0);
        store(target, pixel, seen ? clamp(0.5 * clip.z / clip.w + 0.5, 0.0, 1.0) : 1.0);
        break;
    }
    case AOV_CAMERA_DEPTH:
        store(target, pixel, seen ? -(camera.worldToView * vec4(position, 1.0)).z : 0.0);
        break;
    case AOV_NORMAL:
        store(target, pixel, seen ? normal : vec3(0.0));
        break;
    case AOV_NEYE:
        store(target, pixel, seen ? normalize(mat3(camera.worldToView) * normal) : vec3(0.0));
        break;
    case AOV_PEYE:
        store(target, pixel, seen ? camera.worldToView * vec4(position, 1.0) : vec3(0.0));
        break;
    case AOV_PATCH_COORD:
        store(target, pixel, seen ? vec3(point.uv.x, point.onSegment ? point.place.y : point.uv.y, 0.0) : vec3(0.0));
        break;
    case AOV_PRIM_ID:
        store(target, pixel, seen ? point.instance.primId : -1);
        break;
    case AOV_INSTANCE_ID:
        store(target, pixel, seen ? point.instance.instanceId : -1);
        break;
    case AOV_ELEMENT_ID:
        store(target, pixel, seen ? int(UintRef(point.geometry.triangleFace).v[point.primitive]) : -1);
        break;
    case AOV_PRIMVAR: {
        PrimvarCorners corners;
        if (seen)
            corners = findPrimvar(point.instance, point.geometry, point.primitive, point.vertices, target.primvar);
        store(target, pixel, seen && corners.found ? interpolatePrimvar(corners, point.uv).xyz : vec3(0.0));
        break;
    }
    }
}

// Whether the camera sees anything of a hit.
bool shows(SceneRecord scene, Hit hit, Ray ray) {
    return (scene.flags & SCENE_HAS_NON_OPAQUE) == 0u || evaluatePresence(scene, hit, ray.time) > 0.0;
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i >= HeaderRef(trace.headers).v[QUEUE_RAYS + push.turn].count) return;
    const SceneRecord scene = SceneRef(trace.scene).v;
    const uint pixel = SlotRef(trace.raySlots[push.turn]).v[i];
    const Hit hit = HitRef(trace.hits).v[i];
    Ray ray = RayRef(trace.rays[push.turn]).v[i];
    const bool seen = hit.instance != NO_INDEX;

    if (seen && !shows(scene, hit, ray)) {
        ray.tMin = passedDistance(hit.t);
        const uint other = 1u - push.turn;
        const uint j = appendToQueue(trace, QUEUE_RAYS + other);
        RayRef(trace.rays[other]).v[j] = ray;
        SlotRef(trace.raySlots[other]).v[j] = pixel;
        return;
    }
    const CameraRecord camera = CameraRef(trace.camera).v;
    const float depth = seen ? hit.t * dot(ray.direction, camera.forward) : 0.0;
    uint object = 0u, objectInstance = 0u;
    if (seen) {
        object = InstanceRef(scene.instances).v[hit.instance].object;
        objectInstance = InstanceRef(scene.instances).v[hit.instance].objectInstance;
    }
    VisibilityRef(trace.visibility).v[pixel] =
        VisibilityRecord(hit.instance, hit.primitive, hit.u, hit.v, depth, object, objectInstance);
    if (trace.opaqueDepths != 0ul) DepthRef(trace.opaqueDepths).v[pixel] = depth;
    if (trace.aovCount == 0u) return;
    ShadingPoint point;
    Surface surface;
    surface.position = surface.ns = vec3(0.0);
    if (seen) {
        point = shadingPoint(scene, hit);
        surface = evaluateSurface(scene, hit, ray, NO_FOOTPRINT);
    }
    for (uint k = 0u; k < trace.aovCount; ++k) {
        const AovTarget target = AovTargetRef(trace.aovs).v[k];
        if (target.kind == AOV_MOTION)
            store(target, pixel, seen ? motionVector(trace, scene, hit) : vec2(0.0));
        else
            storeAov(trace, target, pixel, seen, point, surface.position, surface.ns);
    }
}
