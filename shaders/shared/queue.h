// A ray queue as kernels and host stages see it.
#ifndef HIPR_SHARED_QUEUE_H
#define HIPR_SHARED_QUEUE_H
#include "language.h"
HIPR_SHARED_BEGIN

HIPR_CONST uint TRACE_GROUP_SIZE = 64u;

// Filled by appending kernels (count) and by queueHeader().
struct QueueHeader {
    uint count;
    uint groupsX;
    uint groupsY;
    uint groupsZ;
};

// Of a queue that holds `count` entries: sizes the dispatches of those who read it.
HIPR_INLINE QueueHeader queueHeader(uint count) {
    QueueHeader header;
    header.count = count;
    header.groupsX = (count + TRACE_GROUP_SIZE - 1u) / TRACE_GROUP_SIZE;
    header.groupsY = 1u;
    header.groupsZ = 1u;
    return header;
}

// Which instances a ray sees.
HIPR_CONST uint RAY_MASK_OPAQUE = 1u;
HIPR_CONST uint RAY_MASK_NON_OPAQUE = 2u;
HIPR_CONST uint RAY_MASK_ALL = 3u;

// Push constants of every traversal kernel.
struct TracePush {
    uint64_t scene;    // SceneRecord
    uint64_t header;   // QueueHeader
    uint64_t rays;     // Ray[]
    uint64_t hits;     // nearest: Hit[]; occlusion: uint[] (1: blocked)
    uint mask;         // RAY_MASK_*
    uint pad;
};

HIPR_SHARED_END
#endif
