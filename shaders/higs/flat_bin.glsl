// Flat modes: tiles of each splat, in lanes: each invocation bins one of SPLAT_CHUNKS runs of splats. The including kernel
// defines visit() as for bin.glsl.
#ifndef HIPR_HIGS_FLAT_BIN_GLSL
#define HIPR_HIGS_FLAT_BIN_GLSL
#include "higs/bin.glsl"

layout(local_size_x = 8) in;

// Tiles that meet a square around the splat of 3 standard deviations along the ellipse's longer axis (3DGS).
void visitSquare(SplatFrame frame, uint chunk, uint splat) {
    const SplatReach reach = loadReach(frame, splat);
    if (reach.tiles == 0u) return;
    const ProjectedSplat s = loadSplat(frame, splat);
    const vec3 l = s.shape / sqrt(0.5 * LOG2_E); // Cholesky factor of the inverse covariance
    const float yy = 1.0 / (l.z * l.z), determinant_ = yy / (l.x * l.x);
    const float xx = determinant_ * (l.y * l.y + l.z * l.z), middle = 0.5 * (xx + yy);
    const float radius = ceil(3.0 * sqrt(middle + sqrt(max(middle * middle - determinant_, 0.0))));
    const uvec2 rows = tilesOfSpan(s.mean.y - radius, s.mean.y + radius, float(frame.tileHeight), 0u, frame.tileRows);
    const uvec2 columns = tilesOfSpan(s.mean.x - radius, s.mean.x + radius, float(frame.tileWidth), 0u, frame.tileColumns);
    for (uint row = rows.x; row < rows.y; ++row)
        for (uint column = columns.x; column < columns.y; ++column)
            visit(frame, chunk, row * frame.tileColumns + column, splat, reach.key);
}

void visitChunk(SplatFrame frame, uint chunk) {
    const uint each = (frame.splatCount + SPLAT_CHUNKS - 1u) / SPLAT_CHUNKS;
    const uint end = min((chunk + 1u) * each, frame.splatCount);
    const bool squares = (frame.flags & FRAME_SQUARES) != 0u;
    for (uint splat = chunk * each; splat < end; ++splat) {
        if (squares) visitSquare(frame, chunk, splat);
        else visitTiles(frame, chunk, splat);
    }
}
#endif
