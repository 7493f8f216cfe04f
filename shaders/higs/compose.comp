// Puts the batches' pictures together, front to back: C = C_0 + T_0 C_1 + T_0 T_1 C_2 + ..., T = T_0 T_1 ... A batch in which
// the transmittance of a pixel falls below 1/2 is walked again for the splat that did it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/raster_form.glsl"

// Adds a batch to the column; true where it takes a pixel's transmittance below 1/2.
bool addBatch(SplatFrame frame, uint batch, uint renderTile, inout Column column) {
    bool crossed = false;
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y) {
        const SplatPartial part = loadPartial(frame, partialOf(batch, renderTile, pixelInTile() + uvec2(0u, y)));
        const float before = column.transmittance[y], after = before * part.transmittance;
        column.color[y] += before * part.color;
        column.transmittance[y] = after;
        crossed = crossed || (before >= 0.5 && after < 0.5);
    }
    return crossed;
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uvec2 corner = renderTileCorner();
    const uvec2 inTiles = corner / uvec2(frame.tileWidth, frame.tileHeight);
    if (corner.x >= frame.width || corner.y >= frame.height) return;
    const uint index = inTiles.y * frame.tileColumns + inTiles.x;
    if (WordRef(frame.tileMask).v[index] == 0u) return;
    const SplatTile tile = TileRef(frame.tiles).v[index];
    if (!mustWrite(frame, corner, tile.count == 0u)) return;
    const uvec2 pixel = corner + pixelInTile();
    const uint64_t pairs = sortedPairs(frame, tile.side);
    const uint renderTile = renderTileOf(corner), batches = (tile.count + SPLAT_BATCH - 1u) / SPLAT_BATCH;
    Column column = emptyColumn(frame, pixel);
    for (uint i = 0u; i < batches; ++i) {
        Column walk = column;
        const bool crossed = addBatch(frame, tile.firstBatch + i, renderTile, column);
        if (largestOfTile(crossed ? 1.0 : 0.0) > 0.0) {
            const uint skipped = i * SPLAT_BATCH;
            blendHits(frame, pairs, tile.first + skipped, min(tile.count - skipped, SPLAT_BATCH), renderTile,
                      vec2(pixel) + 0.5, walk);
            column.median = walk.median;
        }
        if (largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE) break;
    }
    storeColumn(frame, pixel, column);
}
