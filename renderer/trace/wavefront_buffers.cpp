#include "renderer/trace/wavefront_buffers.h"

namespace hipr {

WavefrontBuffers::WavefrontBuffers(Device& device, uint32_t capacity) : capacity(capacity) {
    const auto make = [&](uint64_t count, size_t stride) {
        return device.createBuffer(count * stride, MemoryUse::Device, "Path queues");
    };
    headers = make(gpu::QUEUE_COUNT, sizeof(gpu::QueueHeader));
    counters = make(1, sizeof(gpu::TraceCounters));
    tiles = make(capacity, sizeof(gpu::TileWork)); // a tile has one path at least
    paths = make(capacity, sizeof(gpu::PathState));
    hits = make(capacity, sizeof(gpu::Hit));
    shadowRays = make(capacity, sizeof(gpu::Ray));
    shadowWork = make(capacity, sizeof(gpu::ShadowWork));
    shadowEnds = make(capacity, sizeof(gpu::Hit));
    shadowResults = make(capacity, sizeof(uint32_t));
    transmitHits = make(capacity, sizeof(gpu::Hit));
    tileChanges = make(capacity, sizeof(gpu::TileChange));
    scoutResults = make(capacity, sizeof(gpu::ScoutResult));
    seen = make(capacity, sizeof(gpu::SeenPoint));
    for (int i = 0; i < 2; ++i) {
        rays[i] = make(capacity, sizeof(gpu::Ray));
        raySlots[i] = make(capacity, sizeof(uint32_t));
        transmitRays[i] = make(capacity, sizeof(gpu::Ray));
        transmitWork[i] = make(capacity, sizeof(gpu::TransmitWork));
    }
    const gpu::QueueHeader empty[gpu::QUEUE_COUNT] = {};
    device.upload(headers, empty, sizeof(empty));
    const gpu::TraceCounters zero{};
    device.upload(counters, &zero, sizeof(zero));
}

void WavefrontBuffers::keepSlots(Device& device, bool keep) {
    if (keep && !slots)
        slots = device.createBuffer(capacity * sizeof(uint32_t), MemoryUse::Device, "Path queues");
    if (!keep) slots = {};
}

void WavefrontBuffers::sortLight(Device& device, gpu::LpeRecord record) {
    if (record.count != lpeCount) {
        const auto make = [&](uint64_t bytes) {
            return record.count > 0 ? device.createBuffer(capacity * bytes, MemoryUse::Device, "Path queues")
                                    : Buffer();
        };
        lpePaths = make(sizeof(gpu::LpePath));
        lpeSums = make(record.count * sizeof(glm::vec3));
        lpeShadows = make(record.count * sizeof(glm::vec3));
        lpeCount = record.count;
    }
    if (record.count == 0) return;
    record.paths = lpePaths.address();
    record.sums = lpeSums.address();
    record.shadows = lpeShadows.address();
    if (!lpe) lpe = device.createBuffer(sizeof(record), MemoryUse::Device, "Path queues");
    device.upload(lpe, &record, sizeof(record));
}

void WavefrontBuffers::describe(gpu::TraceRecord& record) const {
    record.tiles = tiles.address();
    record.headers = headers.address();
    record.counters = counters.address();
    record.paths = paths.address();
    record.hits = hits.address();
    record.shadowRays = shadowRays.address();
    record.shadowWork = shadowWork.address();
    record.shadowEnds = shadowEnds.address();
    record.shadowResults = shadowResults.address();
    record.transmitHits = transmitHits.address();
    record.tileChanges = tileChanges.address();
    record.scoutResults = scoutResults.address();
    record.pathSeen = seen.address();
    for (int i = 0; i < 2; ++i) {
        record.rays[i] = rays[i].address();
        record.raySlots[i] = raySlots[i].address();
        record.transmitRays[i] = transmitRays[i].address();
        record.transmitWork[i] = transmitWork[i].address();
    }
}

TraceQueue WavefrontBuffers::rayQueue(uint32_t turn) const {
    return {&headers, headerOffset(gpu::QUEUE_RAYS + turn), &rays[turn], &hits, gpu::RAY_MASK_ALL};
}

TraceQueue WavefrontBuffers::shadowQueue(uint32_t turn) const {
    return {&headers, headerOffset(gpu::QUEUE_SHADOW + turn), &shadowRays, &shadowResults,
            gpu::RAY_MASK_OPAQUE};
}

TraceQueue WavefrontBuffers::transmitQueue(uint32_t turn, uint32_t mask) const {
    return {&headers, headerOffset(gpu::QUEUE_TRANSMIT + turn), &transmitRays[turn], &transmitHits, mask};
}

} // namespace hipr
