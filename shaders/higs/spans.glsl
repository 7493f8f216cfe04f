// Tiles of the binning grid that an ellipse meets: exact, row by row.
#ifndef HIPR_HIGS_SPANS_GLSL
#define HIPR_HIGS_SPANS_GLSL
#include "higs/frame.glsl"

// From .x to before .y.
uvec2 rowsOf(SplatFrame frame, SplatEllipse e) {
    return tilesOfSpan(e.mean.y - e.half_.y, e.mean.y + e.half_.y, float(frame.tileHeight), 0u, frame.tileRows);
}

// Of a row that it meets.
uvec2 columnsOf(SplatFrame frame, SplatEllipse e, uint row) {
    const float height = float(frame.tileHeight);
    const vec2 span = ellipseSpan(e, float(row) * height, float(row + 1u) * height);
    return tilesOfSpan(span.x, span.y, float(frame.tileWidth), 0u, frame.tileColumns);
}

// SplatReach::tiles
uint tilesOf(SplatFrame frame, SplatEllipse e) {
    const uvec2 rows = rowsOf(frame, e), box =
        tilesOfSpan(e.mean.x - e.half_.x, e.mean.x + e.half_.x, float(frame.tileWidth), 0u, frame.tileColumns);
    if (rows.y - rows.x > SPLAT_NEAR_ROWS || box.y - box.x > SPLAT_NEAR_COLUMNS) return SPLAT_FAR;
    const uint first = rows.x * frame.tileColumns + box.x;
    if (first >> SPLAT_NEAR_SHIFT != 0u) return SPLAT_FAR;
    uint bits = 0u;
    [[unroll]] for (uint i = 0u; i < SPLAT_NEAR_ROWS; ++i) {
        if (rows.x + i >= rows.y) continue;
        const uvec2 columns = clamp(columnsOf(frame, e, rows.x + i), box.xx, box.yy) - box.x;
        bits |= ((1u << columns.y) - (1u << columns.x)) << (i * SPLAT_NEAR_COLUMNS);
    }
    return bits == 0u ? 0u : bits << SPLAT_NEAR_SHIFT | first;
}
#endif
