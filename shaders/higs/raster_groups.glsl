// A workgroup of 64 draws a tile, a pixel an invocation. It collects hits of the tile in shared memory and blends them
// up to 64 at a time; places in the queue follow from the masks' bits, so that no subgroup operation is needed.
#ifndef HIPR_HIGS_RASTER_GROUPS_GLSL
#define HIPR_HIGS_RASTER_GROUPS_GLSL
const uint HEIGHT = 1u, TILES_PER_GROUP = 1u;
#include "higs/raster.glsl"

layout(local_size_x = 64) in;

const uint DRAIN = 64u;

shared uint queue[2u * DRAIN];
shared ProjectedSplat staged[DRAIN];
shared uint largestBits;

uint tileInGroup() { return 0u; }
uvec2 pixelInTile() { return uvec2(gl_LocalInvocationIndex % SPLAT_TILE, gl_LocalInvocationIndex / SPLAT_TILE); }

// The largest of the workgroup's values, which are not negative.
float largestOfTile(float v) {
    barrier();
    if (gl_LocalInvocationIndex == 0u) largestBits = 0u;
    barrier();
    atomicMax(largestBits, floatBitsToUint(v));
    barrier();
    return uintBitsToFloat(largestBits);
}

// Blends the first `count` splats of the queue.
void drain(SplatFrame frame, uint count, vec2 center, inout Column column) {
    barrier();
    if (gl_LocalInvocationIndex < count) staged[gl_LocalInvocationIndex] = loadSplat(frame, queue[gl_LocalInvocationIndex]);
    barrier();
    for (uint i = 0u; i < count; ++i) {
        const ProjectedSplat s = staged[i];
        const vec2 d = center - s.mean;
        const float u = fma(s.shape.x, d.x, s.shape.y * d.y), v = s.shape.z * d.y;
        const float alpha = exp2(-fma(u, u, fma(v, v, s.bias)));
        blendPixel(column, 0u, alpha >= SPLAT_LEAST_ALPHA, alpha, s.color, s.depth, queue[i]);
    }
}

void blendHits(SplatFrame frame, uint64_t pairs, uint first, uint count, uint tile, vec2 center, inout Column column) {
    WordRef masks = WordRef(frame.masks);
    const uint own = gl_LocalInvocationIndex;
    uint queued = 0u;
    for (uint base = 0u; base < count; base += DRAIN) {
        const uint low = masks.v[first + base + tile];
        const uint high = base + SPLAT_MINI_BATCH < count ? masks.v[first + base + SPLAT_MINI_BATCH + tile] : 0u;
        const uint below = (1u << (own % 32u)) - 1u;
        const uint place = own < 32u ? bitCount(low & below) : bitCount(low) + bitCount(high & below);
        barrier(); // nobody reads the queue any more
        if ((((own < 32u ? low : high) >> (own % 32u)) & 1u) != 0u)
            queue[queued + place] = pairSplat(pairs, first + base + own);
        queued += uint(bitCount(low) + bitCount(high));
        const bool last = base + DRAIN >= count;
        if (queued < DRAIN && !last) continue;
        drain(frame, min(queued, DRAIN), center, column);
        if (largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE) return;
        const uint rest = queued - min(queued, DRAIN);
        const uint moved = own < rest ? queue[DRAIN + own] : 0u;
        barrier();
        if (own < rest) queue[own] = moved;
        queued = rest;
        if (last) drain(frame, queued, center, column);
    }
}

void blendAll(SplatFrame frame, uint64_t pairs, uint first, uint count, vec2 center, inout Column column) {
    for (uint base = 0u; base < count; base += DRAIN) {
        const uint own = base + gl_LocalInvocationIndex;
        barrier(); // nobody reads the queue any more
        if (own < count) queue[gl_LocalInvocationIndex] = pairSplat(pairs, first + own);
        drain(frame, min(count - base, DRAIN), center, column);
        if (largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE) return;
    }
}
#endif
