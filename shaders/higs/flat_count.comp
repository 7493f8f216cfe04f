// Flat modes: how many pairs each chunk of splats has.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/flat_bin.glsl"

uint pairs = 0u;

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, float key) { ++pairs; }

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint chunk = invocationIndex(gl_WorkGroupSize.x);
    if (chunk >= SPLAT_CHUNKS) return;
    visitChunk(frame, chunk);
    WordRef(frame.histogram).v[chunk] = pairs;
}
