/// @file wavefront_buffers.h
/// Queues and path states of one batch.
#pragma once

#include "renderer/accel/traversal.h"
#include "shaders/shared/lpe.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// About 450 bytes a path.
struct WavefrontBuffers {
    WavefrontBuffers(Device& device, uint32_t capacity);

    /// Fills the addresses of TraceRecord.
    void describe(gpu::TraceRecord& record) const;

    /// Makes `slots`, where they are to be kept.
    void keepSlots(Device& device, bool keep);
    /// Makes `lpe` and what it refers to, where there are expressions, or lets go of it. About 130 bytes a
    /// path and 24 more for each expression.
    void sortLight(Device& device, gpu::LpeRecord record);

    TraceQueue rayQueue(uint32_t turn) const;
    TraceQueue shadowQueue(uint32_t turn) const;
    /// `mask`: the instances that the rays may meet.
    TraceQueue transmitQueue(uint32_t turn, uint32_t mask) const;
    static uint64_t headerOffset(uint32_t queue) { return queue * sizeof(gpu::QueueHeader); }

    const uint32_t capacity; ///< paths
    Buffer headers, counters, tiles, paths, hits, shadowRays, shadowWork, shadowEnds, shadowResults,
        transmitHits, scoutResults, tileChanges, seen;
    Buffer slots, lpe; ///< where AOVs need them
    Buffer rays[2], raySlots[2], transmitRays[2], transmitWork[2];

private:
    Buffer lpePaths, lpeSums, lpeShadows;
    uint32_t lpeCount = 0; ///< expressions that they are made for
};

} // namespace hipr
