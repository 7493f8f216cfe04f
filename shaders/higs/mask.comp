// The masks of all lists.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/masks.glsl"

layout(local_size_x = 32) in;

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint first = invocationIndex(gl_WorkGroupSize.x) * SPLAT_MINI_BATCH;
    if (first >= StateRef(frame.state).v.pairsEnd) return;
    const uint index = tileOfPair(frame, first);
    writeMasks(frame, index, TileRef(frame.tiles).v[index], first);
}
