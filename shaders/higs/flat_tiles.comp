// Flat modes: where each tile's list begins and ends among the sorted pairs. push.count: the side that holds them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"

layout(local_size_x = 64) in;

uint firstOf(SplatFrame frame, uint tile, uint pairs) {
    TilePairRef sorted = TilePairRef(frame.tilePairs[push.count]);
    uint first = 0u, end = pairs;
    while (first < end) {
        const uint middle = (first + end) / 2u;
        if (sorted.v[middle].tile < tile) first = middle + 1u;
        else end = middle;
    }
    return first;
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint tile = invocationIndex(gl_WorkGroupSize.x);
    if (tile >= frame.tileColumns * frame.tileRows) return;
    StateRef state = StateRef(frame.state);
    const uint pairs = state.v.overflow == 0u ? state.v.pairs : 0u;
    const uint first = firstOf(frame, tile, pairs), count = firstOf(frame, tile + 1u, pairs) - first;
    TileRef(frame.tiles).v[tile] = SplatTile(first, count, 0u, push.count);
    if ((frame.flags & FRAME_PROFILING) != 0u) atomicMax(state.v.largestList, count);
}
