// Blends splats into the pixels of render tiles, front to back. raster_lanes.glsl and raster_groups.glsl say who draws
// which pixels: HEIGHT rows of a column each.
#ifndef HIPR_HIGS_RASTER_GLSL
#define HIPR_HIGS_RASTER_GLSL
#include "higs/frame.glsl"

uint tileInGroup();            // which of TILES_PER_GROUP
uvec2 pixelInTile();           // of the column's first pixel
float largestOfTile(float v); // of all columns of the tile; not negative

struct Column {
    float transmittance[HEIGHT];
    vec3 color[HEIGHT];
    uint median[HEIGHT]; // the last splat that found a transmittance of 1/2 or more
#ifdef LIMITED
    float limit[HEIGHT]; // camera depth of what is opaque
#endif
    uvec2 blends;        // tried, done
};

Column emptyColumn(SplatFrame frame, uvec2 pixel) {
    Column column;
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y) {
        column.transmittance[y] = 1.0;
        column.color[y] = vec3(0.0);
        column.median[y] = NO_SPLAT;
#ifdef LIMITED
        column.limit[y] = 3.402823466e38;
        if (frame.depthLimit != 0ul && pixel.x < frame.width && pixel.y + y < frame.height) {
            const float depth = FloatRef(frame.depthLimit).v[(pixel.y + y) * frame.width + pixel.x];
            if (depth > 0.0) column.limit[y] = depth;
        }
#endif
    }
    column.blends = uvec2(0u);
    return column;
}

float largestTransmittance(Column column) {
    float largest = 0.0;
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y)
        largest = max(largest, column.transmittance[y]);
    return largest;
}

// Blends a splat into a row of the column that it touches, if it does. There are no branches: where half the rows are
// touched, as in tiles of this size, they cost a CPU more than they save.
void blendPixel(inout Column column, uint y, bool touched, float alpha, vec3 color, float depth, uint splat) {
#ifdef LIMITED
    touched = touched && depth <= column.limit[y];
#endif
#ifdef TALLY
    ++column.blends.x;
    if (touched) ++column.blends.y;
#endif
    const float t = column.transmittance[y], weight = touched ? alpha * t : 0.0;
    column.color[y] = fma(vec3(weight), color, column.color[y]);
    column.median[y] = t >= 0.5 ? splat : column.median[y];
    column.transmittance[y] = t - weight;
}

const uint MACRO_COLUMNS = SPLAT_MACRO_WIDTH / SPLAT_TILE, MACRO_ROWS = SPLAT_MACRO_HEIGHT / SPLAT_TILE;

// The first pixel of the render tile that this invocation draws. push.first: of the first row of render tiles to draw.
// Workgroups go along rows of render tiles; or, where lists belong to macro-tiles, through one macro-tile after the other.
uvec2 renderTileCorner() {
    const uint tile = gl_WorkGroupID.x * TILES_PER_GROUP + tileInGroup();
#ifdef FLAT
    return uvec2(tile, push.first + gl_WorkGroupID.y) * SPLAT_TILE;
#else
    const uvec2 macro = uvec2(tile / (MACRO_COLUMNS * MACRO_ROWS), push.first / MACRO_ROWS + gl_WorkGroupID.y);
    const uvec2 within = uvec2(tile % MACRO_COLUMNS, tile / MACRO_COLUMNS % MACRO_ROWS);
    return (macro * uvec2(MACRO_COLUMNS, MACRO_ROWS) + within) * SPLAT_TILE;
#endif
}

// Number of a render tile in its macro-tile.
uint renderTileOf(uvec2 corner) {
    const uvec2 within = corner / SPLAT_TILE % uvec2(MACRO_COLUMNS, MACRO_ROWS);
    return within.y * MACRO_COLUMNS + within.x;
}

uint partialOf(uint batch, uint renderTile, uvec2 pixel) {
    return (batch * 32u + renderTile) * 64u + pixel.y * SPLAT_TILE + pixel.x;
}

// The placement a splat belongs to.
uint placementOf(SplatFrame frame, uint splat) {
    uint first = 0u, end = frame.placementCount;
    if (end > 1u) do {
        const uint middle = (first + end) / 2u;
        if (PlacementRef(frame.placements).v[middle].first <= splat) first = middle;
        else end = middle;
    } while (end - first > 1u);
    return first;
}

// Tells the median splats of pixels where they were written as numbers among all.
void nameMedians(SplatFrame frame, uvec2 pixel) {
    for (uint y = 0u; y < HEIGHT; ++y) {
        const uvec2 at = pixel + uvec2(0u, y);
        if (any(lessThan(at, frame.cropLo)) || any(greaterThanEqual(at, frame.cropHi))) continue;
        const uint i = at.y * frame.width + at.x, median = loadPixelSplat(frame, i);
        if (median == NO_SPLAT) continue;
        PlacementRef placement = PlacementRef(frame.placements);
        const uint index = placementOf(frame, median);
        storePixelMedian(frame, i, loadSplat(frame, median).depth, placement.v[index].primId,
                         placement.v[index].instanceId, median - placement.v[index].first);
    }
}

// Whether the render tile at `corner` has to be written: not if it is empty and was left empty before.
bool mustWrite(SplatFrame frame, uvec2 corner, bool empty_) {
    const uint index = corner.y / SPLAT_TILE * ((frame.width + SPLAT_TILE - 1u) / SPLAT_TILE) + corner.x / SPLAT_TILE;
    WordRef emptied = WordRef(frame.emptied);
    // All have read the flag before one changes it.
    const bool wasEmpty = largestOfTile(emptied.v[index] != 0u ? 1.0 : 0.0) > 0.0;
    if (pixelInTile() == uvec2(0u)) emptied.v[index] = empty_ ? 1u : 0u;
    return !(empty_ && wasEmpty);
}

void storeColumn(SplatFrame frame, uvec2 pixel, Column column) {
    bool named = false;
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y) {
        const uvec2 at = pixel + uvec2(0u, y);
        const float t = max(column.transmittance[y], 0.0); // alphas are right to 3e-5
        const uint median = t < 0.5 ? column.median[y] : NO_SPLAT;
        named = named || median != NO_SPLAT;
        if (all(greaterThanEqual(at, frame.cropLo)) && all(lessThan(at, frame.cropHi)))
            storePixel(frame, at.y * frame.width + at.x, SplatPixel(column.color[y], t, 0.0, -1, -1, median));
    }
    if (named) nameMedians(frame, pixel);
}
#endif
