// Draws render tiles from the lists of the tiles they lie in.
// FLAT: all splats of a list are tried; else masks tell which hit the tile. In lanes, where a workgroup draws a macro-tile, it
// makes its masks first: they and the splats are then in its processor's caches.
// TALLY: nothing is drawn; blends are counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/raster_form.glsl"
#if defined(LANES) && !defined(FLAT)
#define OWN_MASKS
#include "higs/masks.glsl"

void makeMasks(SplatFrame frame) {
    const uvec2 macro = uvec2(gl_WorkGroupID.x, push.first / MACRO_ROWS + gl_WorkGroupID.y);
    const uint index = macro.y * frame.tileColumns + macro.x;
    const SplatTile tile = TileRef(frame.tiles).v[index];
    const uint count = WordRef(frame.tileMask).v[index] != 0u ? tile.count : 0u;
    uint i = (tileInGroup() * LANES_PER_TILE + laneInTile()) * SPLAT_MINI_BATCH;
    if (i < count) do {
        writeMasks(frame, index, tile, tile.first + i);
        i += gl_WorkGroupSize.x * SPLAT_MINI_BATCH;
    } while (i < count);
    memoryBarrierBuffer();
    barrier();
}
#endif

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
#ifdef OWN_MASKS
    makeMasks(frame);
#endif
    const uvec2 corner = renderTileCorner(), inTiles = corner / uvec2(frame.tileWidth, frame.tileHeight);
    if (corner.x >= frame.width || corner.y >= frame.height) return;
    const uint index = inTiles.y * frame.tileColumns + inTiles.x;
    if (WordRef(frame.tileMask).v[index] == 0u) return;
    const SplatTile tile = TileRef(frame.tiles).v[index];
#ifndef TALLY
    if (!mustWrite(frame, corner, tile.count == 0u)) return;
#endif
    const uint64_t pairs = sortedPairs(frame, tile.side);
    const uvec2 pixel = corner + pixelInTile();
    const vec2 center = vec2(pixel) + 0.5;
    Column column = emptyColumn(frame, pixel);
#ifdef FLAT
    blendAll(frame, pairs, tile.first, tile.count, center, column);
#else
    blendHits(frame, pairs, tile.first, tile.count, renderTileOf(corner), center, column);
#endif
#ifdef TALLY
    atomicAdd(Uvec2Ref(frame.blends).v[index].x, column.blends.x);
    atomicAdd(Uvec2Ref(frame.blends).v[index].y, column.blends.y);
#else
    storeColumn(frame, pixel, column);
#endif
}
