// Flat modes: writes all pairs, in order of splats.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/flat_bin.glsl"
#include "higs/ray_hit.glsl"

uint place = 0u;

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, float key) {
    if (frame.rays != 0ul) key = rayHitDistance(frame, tile, splat);
    TilePairRef(frame.tilePairs[0]).v[place] = SplatTilePair(floatBitsToUint(key), splat, tile);
    ++place;
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint chunk = invocationIndex(gl_WorkGroupSize.x);
    if (chunk >= SPLAT_CHUNKS || StateRef(frame.state).v.overflow != 0u) return;
    place = WordRef(frame.histogram).v[chunk];
    visitChunk(frame, chunk);
}
