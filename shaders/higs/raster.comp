// Draws render tiles from the lists of the tiles they lie in.
// FLAT: all splats of a list are tried; else masks tell which hit the tile.
// TALLY: nothing is drawn; blends are counted.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/raster_form.glsl"

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uvec2 group = uvec2(gl_WorkGroupID.x, push.first + gl_WorkGroupID.y);
    const uvec2 corner = uvec2(group.x * TILES_PER_GROUP + tileInGroup(), group.y) * SPLAT_TILE;
    const uvec2 inTiles = corner / uvec2(frame.tileWidth, frame.tileHeight);
    if (corner.x >= frame.width || corner.y >= frame.height) return;
    const uint index = inTiles.y * frame.tileColumns + inTiles.x;
    if (WordRef(frame.tileMask).v[index] == 0u) return;
    const SplatTile tile = TileRef(frame.tiles).v[index];
#ifndef TALLY
    if (!mustWrite(frame, corner, tile.count == 0u)) return;
#endif
    const uvec2 pixel = corner + pixelInTile();
    const vec2 center = vec2(pixel) + 0.5;
    Column column = emptyColumn(frame, pixel);
#ifdef FLAT
    blendAll(frame, tile.side, tile.first, tile.count, center, column);
#else
    blendHits(frame, tile.side, tile.first, tile.count, renderTileOf(corner), center, column);
#endif
#ifdef TALLY
    atomicAdd(Uvec2Ref(frame.blends).v[index].x, column.blends.x);
    atomicAdd(Uvec2Ref(frame.blends).v[index].y, column.blends.y);
#else
    storeColumn(frame, pixel, column);
#endif
}
