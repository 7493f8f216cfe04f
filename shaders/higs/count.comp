// How many splats each tile's list gets: by chunk of splats, or by all invocations in one row of counters.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/bin_all.glsl"

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, float key) {
    WordRef histogram = WordRef(frame.histogram);
#ifdef LANES
    histogram.v[chunk * frame.tileColumns * frame.tileRows + tile] += 1u;
#else
    atomicAdd(histogram.v[tile], 1u);
#endif
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    visitAll(frame);
}
