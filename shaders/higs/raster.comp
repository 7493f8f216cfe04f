// Draws render tiles from the lists of the tiles they lie in. A workgroup draws 64 x 8 pixels.
// FLAT: all splats of the list may hit; else masks tell which do.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/raster.glsl"

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uvec2 group = uvec2(gl_WorkGroupID.x, push.first + gl_WorkGroupID.y);
    const uvec2 corner = uvec2(group.x * 8u + tileInGroup(), group.y) * SPLAT_TILE;
    const uvec2 inTiles = corner / uvec2(frame.tileWidth, frame.tileHeight);
    if (inTiles.x >= frame.tileColumns || inTiles.y >= frame.tileRows) return;
    const uint index = inTiles.y * frame.tileColumns + inTiles.x;
    if (WordRef(frame.tileMask).v[index] == 0u) return;
    const SplatTile tile = TileRef(frame.tiles).v[index];
    const uvec2 pixel = corner + uvec2(laneInTile(), 0u);
    const vec2 center = vec2(pixel) + 0.5;
    Column column = emptyColumn(frame, pixel);
#ifdef FLAT
    blendAll(frame, tile.side, tile.first, tile.count, center, column);
#else
    const uint word = (group.y * SPLAT_TILE % SPLAT_MACRO_HEIGHT) / SPLAT_TILE * 8u + tileInGroup();
    blendHits(frame, tile.side, tile.first, tile.count, word, center, column);
#endif
    storeColumn(frame, pixel, column);
#ifdef COUNT_BLENDS
    atomicAdd(Uvec2Ref(frame.blends).v[index].x, column.blends.x);
    atomicAdd(Uvec2Ref(frame.blends).v[index].y, column.blends.y);
#endif
}
