// Draws the render tiles of each batch by itself, as if nothing were in front. Workgroups: x goes over the tiles of a
// macro-tile, y and z over batches.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/raster_form.glsl"

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint batch = gl_WorkGroupID.z * gl_NumWorkGroups.y + gl_WorkGroupID.y;
    if (batch >= StateRef(frame.state).v.batches) return;
    const uint index = tileOfBatch(frame, batch);
    const SplatTile tile = TileRef(frame.tiles).v[index];
    const uint renderTile = gl_WorkGroupID.x * TILES_PER_GROUP + tileInGroup();
    const uvec2 macro = uvec2(index % frame.tileColumns, index / frame.tileColumns);
    const uvec2 corner = macro * uvec2(SPLAT_MACRO_WIDTH, SPLAT_MACRO_HEIGHT) +
                         uvec2(renderTile % 8u, renderTile / 8u) * SPLAT_TILE;
    const uvec2 pixel = corner + pixelInTile();
    const uint skipped = (batch - tile.firstBatch) * SPLAT_BATCH;
    Column column = emptyColumn(frame, pixel);
    blendHits(frame, sortedPairs(frame, tile.side), tile.first + skipped, min(tile.count - skipped, SPLAT_BATCH), renderTile,
              vec2(pixel) + 0.5, column);
#ifdef TALLY
    atomicAdd(Uvec2Ref(frame.blends).v[index].x, column.blends.x);
    atomicAdd(Uvec2Ref(frame.blends).v[index].y, column.blends.y);
#else
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y)
        storePartial(frame, partialOf(batch, renderTile, pixelInTile() + uvec2(0u, y)),
                     SplatPartial(column.color[y], column.transmittance[y]));
#endif
}
