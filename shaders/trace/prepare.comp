// Between an appending kernel and the readers of its queues: sizes their indirect dispatches, counts rays, and empties
// the queues that come next. One invocation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"

void main() {
    if (gl_GlobalInvocationID.x != 0u) return;
    const TraceRecord trace = TraceRecordRef(push.record).v;
    HeaderRef headers = HeaderRef(trace.headers);
    CountersRef counters = CountersRef(trace.counters);
    for (uint queue = 0u; queue < QUEUE_COUNT; ++queue) {
        if ((push.first >> (8u + queue) & 1u) != 0u) headers.v[queue] = queueHeader(0u);
        if ((push.first >> queue & 1u) == 0u) continue;
        const uint count = headers.v[queue].count;
        headers.v[queue] = queueHeader(count);
        counters.v.rays[queue / 2u] += count;
    }
}
