// For every tile: sums the counts of the chunks, leaving in each chunk's place where its splats begin in the list.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"

layout(local_size_x = 8) in;

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint tileCount = frame.tileColumns * frame.tileRows, tile = invocationIndex(gl_WorkGroupSize.x);
    if (tile >= tileCount) return;
    WordRef histogram = WordRef(frame.histogram);
    uint sum = 0u;
    for (uint chunk = 0u; chunk < SPLAT_CHUNKS; ++chunk) {
        const uint counter = chunk * tileCount + tile, count = histogram.v[counter];
        histogram.v[counter] = sum;
        sum += count;
    }
    TileRef(frame.tiles).v[tile].count = sum;
}
