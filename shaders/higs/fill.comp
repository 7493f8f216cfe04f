// Writes the tiles' lists: every splat finds its places where `count`, and the sums over it, say. In lanes lists come
// out in order of splats, otherwise in any order; sorting makes both the same.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/bin_all.glsl"
#include "higs/ray_hit.glsl"

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, float key) {
    if (WordRef(frame.tileMask).v[tile] == 0u) return;
    WordRef histogram = WordRef(frame.histogram);
#ifdef LANES
    const uint counter = chunk * frame.tileColumns * frame.tileRows + tile;
    const uint slot = histogram.v[counter];
    histogram.v[counter] = slot + 1u;
#else
    const uint slot = atomicAdd(histogram.v[tile], 1u);
#endif
    if (frame.rays != 0ul) key = rayHitDistance(frame, tile, splat);
    PairRef(frame.pairs[0]).v[TileRef(frame.tiles).v[tile].first + slot] =
        packPair(floatBitsToUint(key), splat);
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    if (StateRef(frame.state).v.overflow != 0u) return;
    visitAll(frame);
}
