// Rays through the centres of pixels push.first + [0, push.count), at the frame's time.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/camera.glsl"

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const uint i = gl_GlobalInvocationID.x;
    if (i == 0u) HeaderRef(trace.headers).v[QUEUE_RAYS].count = push.count;
    if (i >= push.count) return;
    const uint pixel = push.first + i;
    const vec2 film = vec2(pixel % trace.width, pixel / trace.width) + 0.5;
    Ray ray = cameraRay(CameraRef(trace.camera), film, uvec2(trace.width, trace.height));
    ray.time = trace.frameTime;
    RayRef(trace.rays[0]).v[i] = ray;
    SlotRef(trace.raySlots[0]).v[i] = pixel;
}
