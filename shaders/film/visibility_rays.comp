// Rays through the centres of pixels push.first + [0, push.count).
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
    RayRef(trace.rays[0]).v[i] = cameraRay(CameraRef(trace.camera), film, uvec2(trace.width, trace.height));
    SlotRef(trace.raySlots[0]).v[i] = pixel;
}
