// Lists the pixels of the new picture to which nothing came, or in which something nearer may have left a crack: they
// are few, and dear to mend. An invocation goes down CARRIED_ROWS pixels of a column.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "hipr/reprojection.glsl"

// The depths of three pixels side by side.
uvec3 depthsAt(uint x, uint y) {
    ListRef depths = list(CARRIED_DEPTHS);
    const uint i = x + y * push.width, last = push.width - 1u;
    return uvec3(x > 0u ? depths.v[i - 1u] : NO_INDEX, depths.v[i], x < last ? depths.v[i + 1u] : NO_INDEX);
}

// Whether two pixels show one surface, nearer than `depth`.
bool nearer(uint a, uint b, float depth) {
    const float u = uintBitsToFloat(a), v = uintBitsToFloat(b);
    return a != NO_INDEX && b != NO_INDEX && oneSurface(u, v) && max(u, v) < depth && !oneSurface(u, depth);
}

void main() {
    const uint x = gl_GlobalInvocationID.x, first = gl_WorkGroupID.y * CARRIED_ROWS;
    if (x >= push.width) return;
    uvec3 above = first > 0u ? depthsAt(x, first - 1u) : uvec3(NO_INDEX);
    uvec3 here = depthsAt(x, first);
    uint torn = 0u; // a bit a pixel
    for (uint y = first; y < min(first + CARRIED_ROWS, push.height); ++y) {
        const uvec3 below = y + 1u < push.height ? depthsAt(x, y + 1u) : uvec3(NO_INDEX);
        const float depth = uintBitsToFloat(here.y);
        if (here.y == NO_INDEX || nearer(here.x, here.z, depth) || nearer(above.y, below.y, depth) ||
            nearer(above.x, below.z, depth) || nearer(above.z, below.x, depth))
            torn |= 1u << (y - first);
        above = here;
        here = below;
    }
    if (torn == 0u) return;
    uint entry = atomicAdd(CountsRef(push.counts).v.torn, uint(bitCount(torn)));
    for (; torn != 0u; torn &= torn - 1u)
        list(CARRIED_TORN).v[entry++] = x | (first + uint(findLSB(torn))) << 16u;
}
