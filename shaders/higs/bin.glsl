// Walks the tiles of the binning grid that splats meet. The including kernel says what to do there:
//   void visit(SplatFrame frame, uint chunk, uint tile, uint splat, float key)
#ifndef HIPR_HIGS_BIN_GLSL
#define HIPR_HIGS_BIN_GLSL
#include "higs/frame.glsl"
#include "higs/spans.glsl"

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, float key);

// Tiles of a splat that `project` did not list.
void visitFar(SplatFrame frame, uint chunk, uint splat, float key) {
    const ProjectedSplat s = loadSplat(frame, splat);
    const SplatEllipse e = splatEllipse(s.mean, s.shape, splatReach(s.bias));
    const uvec2 rows = rowsOf(frame, e);
    for (uint row = rows.x; row < rows.y; ++row) {
        const uvec2 columns = columnsOf(frame, e, row);
        for (uint column = columns.x; column < columns.y; ++column)
            visit(frame, chunk, row * frame.tileColumns + column, splat, key);
    }
}

void visitTiles(SplatFrame frame, uint chunk, uint splat) {
    const SplatReach reach = loadReach(frame, splat);
    if (reach.tiles == SPLAT_FAR) {
        visitFar(frame, chunk, splat, reach.key);
        return;
    }
    const uint first = reach.tiles & ((1u << SPLAT_NEAR_SHIFT) - 1u);
    uint bits = reach.tiles >> SPLAT_NEAR_SHIFT;
    if (bits != 0u) do {
        const uint bit = uint(findLSB(bits));
        const uint row = bit / SPLAT_NEAR_COLUMNS, column = bit % SPLAT_NEAR_COLUMNS;
        visit(frame, chunk, first + row * frame.tileColumns + column, splat, reach.key);
        bits &= bits - 1u;
    } while (bits != 0u);
}
#endif
