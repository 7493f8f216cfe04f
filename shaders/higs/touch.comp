// Marks the tiles in which splats of blocks from push.first to before push.count are.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/bin.glsl"

layout(local_size_x = 256) in;

void visit(SplatFrame frame, uint chunk, uint tile, uint splat, float key) {
    WordRef(frame.tileMask).v[tile] = 1u;
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint block = push.first + workgroupIndex();
    if (block >= push.count) return;
    const SplatBlock source = BlockRef(frame.blocks).v[block];
    const SplatPlacement placement = PlacementRef(frame.placements).v[source.placement];
    const uint local = source.first + gl_LocalInvocationIndex;
    if (local < placement.arrays.count) visitTiles(frame, 0u, placement.first + local);
}
