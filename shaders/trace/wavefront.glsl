// What every wavefront kernel shares: the buffers behind TraceRecord and queue appends.
#ifndef HIPR_TRACE_WAVEFRONT_GLSL
#define HIPR_TRACE_WAVEFRONT_GLSL
#include "shared/references.glsl"
#include "shared/features.glsl"
#include "shared/queue.h"
#include "shared/trace.h"
#include "trace/lpe.glsl"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_ballot : require

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer TraceRecordRef { TraceRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CameraRef { CameraRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer TileRef { TileWork v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer AovTargetRef { AovTarget v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer HeaderRef { QueueHeader v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer CountersRef { TraceCounters v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PathRef { PathState v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RayRef { Ray v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SlotRef { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer HitRef { Hit v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer ShadowWorkRef { ShadowWork v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer TransmitWorkRef { TransmitWork v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FilmRef { FilmPixel v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PathSeenRef { SeenPoint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer VisibilityRef { VisibilityRecord v[]; };

layout(push_constant, scalar) uniform Push { TraceKernelPush push; };

const float RAY_INFINITY = 3.402823466e38;

// The index of a new entry of a queue; one atomic a subgroup. Entries land in any order, which no result depends on.
uint appendToQueue(TraceRecord trace, uint queue) {
    const uvec4 active_ = subgroupBallot(true);
    uint first = 0u;
    if (subgroupElect()) first = atomicAdd(HeaderRef(trace.headers).v[queue].count, subgroupBallotBitCount(active_));
    return subgroupBroadcastFirst(first) + subgroupBallotExclusiveBitCount(active_);
}

bool allFinite(vec3 v) {
    return !(any(isnan(v)) || any(isinf(v)));
}

// Adds radiance to a path, in memory: most events add none, so paths do not carry their sums around. A value that is
// not finite is dropped and counted: one broken material or texel must not blacken a pixel for good.
void addRadiance(TraceRecord trace, uint slot, vec3 value, bool indirect) {
    if (value == vec3(0.0)) return;
    PathRef paths = PathRef(trace.paths);
    if (!allFinite(value))
        atomicAdd(CountersRef(trace.counters).v.nonFinite, 1u);
    else if (indirect)
        paths.v[slot].indirect += value;
    else
        paths.v[slot].radiance += value;
}

// All the light a finished path brought to its pixel.
vec3 pathRadiance(TraceRecord trace, PathState path) {
    vec3 indirect = path.indirect;
    const float largest = max(indirect.r, max(indirect.g, indirect.b));
    if (trace.fireflyClamp > 0.0 && largest > trace.fireflyClamp) indirect *= trace.fireflyClamp / largest;
    return path.radiance + indirect;
}

// Whether light is sorted by light path expressions.
bool sortsLight(TraceRecord trace) { return sceneHas(FILM_SORTS_LIGHT) && trace.lpe != 0ul; }

// Adds a share of what a shadow ray carries.
void arrive(TraceRecord trace, ShadowWork work, vec3 share) {
    const uint slot = work.slot & ~SHADOW_INDIRECT;
    const vec3 value = work.contribution * share;
    addRadiance(trace, slot, value, (work.slot & SHADOW_INDIRECT) != 0u);
    if (sortsLight(trace)) arriveInExpressions(trace.lpe, slot, value);
}

// Just behind a surface that was passed through. The origin stays, so that pdfs of lights further along the ray remain
// those of the vertex the ray left from.
float passedDistance(float t) {
    return t * (1.0 + 1e-5) + 1e-6;
}
#endif
