// Flat modes: one pass of a radix sort over (tile, key), least significant digit first; push.first is the digit's shift, 32
// and above for the tile. In lanes: each invocation counts, and then moves, one of SPLAT_CHUNKS runs of pairs.
// COUNT: counts the digits; else moves pairs to where the sums over the counters say.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"

layout(local_size_x = 8) in;

uint digitOf(SplatTilePair pair) {
    const uint word = push.first < 32u ? pair.key : pair.tile;
    return (word >> (push.first % 32u)) & (SPLAT_DIGITS - 1u);
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint chunk = invocationIndex(gl_WorkGroupSize.x);
    if (chunk >= SPLAT_CHUNKS || StateRef(frame.state).v.overflow != 0u) return;
    const uint pairs = StateRef(frame.state).v.pairs, each = (pairs + SPLAT_CHUNKS - 1u) / SPLAT_CHUNKS;
    const uint first = min(chunk * each, pairs), end = min(first + each, pairs);
    TilePairRef from = TilePairRef(frame.tilePairs[push.count]);
    WordRef histogram = WordRef(frame.histogram);
    uint places[SPLAT_DIGITS];
#ifdef COUNT
    for (uint d = 0u; d < SPLAT_DIGITS; ++d)
        places[d] = 0u;
    for (uint i = first; i < end; ++i)
        places[digitOf(from.v[i])] += 1u;
    for (uint d = 0u; d < SPLAT_DIGITS; ++d)
        histogram.v[d * SPLAT_CHUNKS + chunk] = places[d];
#else
    TilePairRef to = TilePairRef(frame.tilePairs[1u - push.count]);
    for (uint d = 0u; d < SPLAT_DIGITS; ++d)
        places[d] = histogram.v[d * SPLAT_CHUNKS + chunk];
    for (uint i = first; i < end; ++i) {
        const SplatTilePair pair = from.v[i];
        const uint d = digitOf(pair), place = places[d];
        places[d] = place + 1u;
        to.v[place] = pair;
    }
    if ((frame.flags & FRAME_PROFILING) != 0u) atomicAdd(StateRef(frame.state).v.sortMoves, end - first);
#endif
}
