// Adds a batch's samples to the film, one pixel an invocation and its samples in order, so that sums round alike
// however samples were spread over batches. Workgroups: x covers the pixels of a tile, y is the tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/wavefront.glsl"

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const TileWork tile = TileRef(trace.tiles).v[gl_WorkGroupID.y];
    const uint local = gl_GlobalInvocationID.x;
    if (local >= tile.width * tile.height) return;
    const uint pixel = tile.x + local % tile.width + (tile.y + local / tile.width) * trace.width;

    // The first sample replaces what an earlier picture left in the pixel.
    FilmPixel sum = FilmPixel(vec4(0.0), vec3(0.0), 0u);
    if (tile.firstSample != 0u) sum = FilmRef(trace.film).v[pixel];
    for (uint i = 0u; i < tile.sampleCount; ++i) {
        const PathState path = PathRef(trace.paths).v[tile.firstSlot + local * tile.sampleCount + i];
        vec3 indirect = path.indirect;
        const float largest = max(indirect.r, max(indirect.g, indirect.b));
        if (trace.fireflyClamp > 0.0 && largest > trace.fireflyClamp) indirect *= trace.fireflyClamp / largest;
        sum.color += vec4(path.radiance + indirect, path.alpha);
        sum.albedo += path.albedo;
    }
    sum.count = tile.firstSample + tile.sampleCount;
    FilmRef(trace.film).v[pixel] = sum;
}
