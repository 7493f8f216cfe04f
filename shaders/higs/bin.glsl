// Walks the tiles of the binning grid that splats meet. The including kernel says what to do there:
//   void visit(SplatFrame frame, uint chunk, uint tile, uint splat, ProjectedSplat s)
#ifndef HIPR_HIGS_BIN_GLSL
#define HIPR_HIGS_BIN_GLSL
#include "higs/frame.glsl"

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, ProjectedSplat s);

void visitTiles(SplatFrame frame, uint chunk, uint splat) {
    if (!(loadBias(frame, splat) < SPLAT_SIGMA_LIMIT)) return;
    const ProjectedSplat s = loadSplat(frame, splat);
    const SplatEllipse e = splatEllipse(s.mean, s.shape, splatReach(s.bias));
    const vec2 size = vec2(frame.tileWidth, frame.tileHeight);
    const uvec2 rows = tilesOfSpan(e.mean.y - e.half_.y, e.mean.y + e.half_.y, size.y, 0u, frame.tileRows);
    for (uint row = rows.x; row < rows.y; ++row) {
        const vec2 span = ellipseSpan(e, float(row) * size.y, float(row + 1u) * size.y);
        const uvec2 columns = tilesOfSpan(span.x, span.y, size.x, 0u, frame.tileColumns);
        for (uint column = columns.x; column < columns.y; ++column)
            visit(frame, chunk, row * frame.tileColumns + column, splat, s);
    }
}
#endif
