// Sorts each batch of a list by key, then by splat.
//
// LANES: one invocation a batch, by itself: a radix sort, least significant digit first, over as many bits as the keys of
// the batch differ in. It keeps the order of equal keys, in which `fill` has put the splats. Otherwise a workgroup sorts
// the batch in shared memory by K. Batcher's bitonic network (AFIPS 1968).
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"

#ifdef LANES
layout(local_size_x = 8) in;

const uint DIGIT_BITS = 8u, DIGITS = SPLAT_DIGITS;

uint keyOf(PairRef pairs, uint i) { return WordRef(uint64_t(pairs)).v[2u * i + 1u]; }

// Of the batch's keys above the least: as many bits as differ.
uint keyBits(PairRef pairs, uint first, uint count, out uint least) {
    least = 0xffffffffu;
    uint most = 0u;
    for (uint i = 0u; i < count; ++i) {
        const uint key = keyOf(pairs, first + i);
        least = min(least, key);
        most = max(most, key);
    }
    return count > 1u ? uint(findMSB(most - least) + 1) : 0u;
}

void sortDigit(PairRef from, PairRef to, uint first, uint count, uint least, uint shift, uint digits) {
    uint places[DIGITS];
    for (uint d = 0u; d < digits; ++d)
        places[d] = 0u;
    for (uint i = 0u; i < count; ++i)
        places[((keyOf(from, first + i) - least) >> shift) & (digits - 1u)] += 1u;
    uint sum = 0u;
    for (uint d = 0u; d < digits; ++d) {
        const uint n = places[d];
        places[d] = sum;
        sum += n;
    }
    for (uint i = 0u; i < count; ++i) {
        const uint64_t pair = from.v[first + i];
        const uint d = ((unpackUint2x32(pair).y - least) >> shift) & (digits - 1u);
        const uint place = places[d];
        places[d] = place + 1u;
        to.v[first + place] = pair;
    }
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint batch = invocationIndex(gl_WorkGroupSize.x);
    if (batch >= StateRef(frame.state).v.batches) return;
    const SplatTile tile = TileRef(frame.tiles).v[tileOfBatch(frame, batch)];
    const uint skipped = (batch - tile.firstBatch) * SPLAT_BATCH;
    const uint first = tile.first + skipped, count = min(tile.count - skipped, SPLAT_BATCH);
    uint least;
    const uint bits = keyBits(PairRef(frame.pairs[0]), first, count, least);
    // As few passes as digits of DIGIT_BITS allow, and digits no larger than these need.
    const uint passes = (bits + DIGIT_BITS - 1u) / DIGIT_BITS, digitBits = (bits + passes - 1u) / max(passes, 1u);
    uint side = 0u;
    for (uint shift = 0u; shift < bits; shift += digitBits) {
        sortDigit(PairRef(frame.pairs[side]), PairRef(frame.pairs[1u - side]), first, count, least, shift, 1u << digitBits);
        side = 1u - side;
    }
    if ((frame.flags & FRAME_PROFILING) != 0u)
        atomicAdd(StateRef(frame.state).v.sortMoves, count * (passes + side));
    for (uint i = 0u; i < count && side != 0u; ++i)
        PairRef(frame.pairs[0]).v[first + i] = PairRef(frame.pairs[1]).v[first + i];
}
#else
layout(local_size_x = 256) in;

shared uint64_t batchPairs[SPLAT_BATCH];

void compareExchange(uint low, uint high) {
    const uint64_t a = batchPairs[low], b = batchPairs[high];
    if (a <= b) return;
    batchPairs[low] = b;
    batchPairs[high] = a;
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint batch = workgroupIndex();
    const SplatTile tile = TileRef(frame.tiles).v[tileOfBatch(frame, batch)];
    const uint skipped = (batch - tile.firstBatch) * SPLAT_BATCH;
    const uint first = tile.first + skipped, count = min(tile.count - skipped, SPLAT_BATCH);
    PairRef pairs = PairRef(frame.pairs[0]);
    for (uint i = gl_LocalInvocationIndex; i < SPLAT_BATCH; i += gl_WorkGroupSize.x) {
        batchPairs[i] = i < count ? pairs.v[first + i] : ~0ul;
    }
    barrier();
    for (uint run = 2u; run <= SPLAT_BATCH; run *= 2u) {
        // The first step mirrors the second half of a run, so that all others compare in the same direction.
        for (uint i = gl_LocalInvocationIndex; i < SPLAT_BATCH / 2u; i += gl_WorkGroupSize.x) {
            const uint start = i / (run / 2u) * run, within = i % (run / 2u);
            compareExchange(start + within, start + run - 1u - within);
        }
        barrier();
        for (uint stride = run / 4u; stride > 0u; stride /= 2u) {
            for (uint i = gl_LocalInvocationIndex; i < SPLAT_BATCH / 2u; i += gl_WorkGroupSize.x) {
                const uint low = i / stride * stride * 2u + i % stride;
                compareExchange(low, low + stride);
            }
            barrier();
        }
    }
    for (uint i = gl_LocalInvocationIndex; i < count; i += gl_WorkGroupSize.x)
        pairs.v[first + i] = batchPairs[i];
    if ((frame.flags & FRAME_PROFILING) != 0u && gl_LocalInvocationIndex == 0u)
        atomicAdd(StateRef(frame.state).v.sortMoves, count);
}
#endif
