// What every traversal kernel has: its queue and its place in it.
#ifndef HIPR_ACCEL_TRACE_KERNEL_GLSL
#define HIPR_ACCEL_TRACE_KERNEL_GLSL
#include "shared/references.glsl"
#include "shared/queue.h"

layout(local_size_x = TRACE_GROUP_SIZE) in;
layout(push_constant, scalar) uniform Push { TracePush push; };

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer HeaderRef { QueueHeader v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer RayRef { Ray v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer HitRef { Hit v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer BlockedRef { uint v[]; };

uint rayIndex() {
    return (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * TRACE_GROUP_SIZE + gl_LocalInvocationID.x;
}

bool inQueue(uint i) { return i < HeaderRef(push.header).v.count; }

void writeResult(uint i, Hit hit) {
#ifdef HIPR_OCCLUSION
    BlockedRef(push.hits).v[i] = hit.instance == NO_INDEX ? 0u : 1u;
#else
    HitRef(push.hits).v[i] = hit;
#endif
}
#endif
