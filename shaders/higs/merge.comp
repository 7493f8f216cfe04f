// Merges neighbouring sorted runs of SPLAT_BATCH << push.first pairs. Each invocation finds its part of the result by
// binary search along the merge path (O. Green, R. McColl, D. Bader, "GPU merge path", ICS 2012) and merges it serially.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"

#ifdef LANES
layout(local_size_x = 8) in;
const uint PARTS = 1u; // of a batch
#else
layout(local_size_x = 64) in;
const uint PARTS = 64u;
#endif

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint part = invocationIndex(gl_WorkGroupSize.x), batch = part / PARTS;
    if (batch >= StateRef(frame.state).v.batches) return;
    const SplatTile tile = TileRef(frame.tiles).v[tileOfBatch(frame, batch)];
    const uint run = SPLAT_BATCH << push.first;
    if (tile.count <= run) return; // sorted already, in the array where it stays
    const uint size = SPLAT_BATCH / PARTS;
    const uint begin = (batch - tile.firstBatch) * SPLAT_BATCH + part % PARTS * size;
    if (begin >= tile.count) return;
    const uint end = min(begin + size, tile.count);

    PairRef from = PairRef(frame.pairs[push.first & 1u]), to = PairRef(frame.pairs[~push.first & 1u]);
    const uint start = begin / (2u * run) * 2u * run;
    const uint middle = min(start + run, tile.count), stop = min(start + 2u * run, tile.count);
    // How many of the first `begin - start` pairs come from the first run.
    uint low = max(int(begin - start) - int(stop - middle), 0), high = min(begin - start, middle - start);
    while (low < high) {
        const uint a = (low + high) / 2u, b = begin - start - 1u - a;
        if (from.v[tile.first + middle + b] < from.v[tile.first + start + a]) high = a;
        else low = a + 1u;
    }
    if ((frame.flags & FRAME_PROFILING) != 0u) atomicAdd(StateRef(frame.state).v.sortMoves, end - begin);
    uint a = start + low, b = middle + (begin - start - low);
    for (uint i = begin; i < end; ++i) {
        bool first = b >= stop;
        uint64_t pair = ~0ul;
        if (!first) {
            pair = from.v[tile.first + b];
            if (a < middle) {
                const uint64_t other = from.v[tile.first + a];
                if (other < pair) {
                    first = true;
                    pair = other;
                }
            }
        } else
            pair = from.v[tile.first + a];
        to.v[tile.first + i] = pair;
        if (first) ++a;
        else ++b;
    }
}
