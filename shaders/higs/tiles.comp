// Places the tiles' lists one behind the other and sizes everything that follows. One workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"
#include "higs/scan.glsl"

shared uint totalPairs, longest;

uvec2 sizeOf(uint count) {
    return uvec2((count + SPLAT_MINI_BATCH - 1u) / SPLAT_MINI_BATCH * SPLAT_MINI_BATCH,
                 (count + SPLAT_BATCH - 1u) / SPLAT_BATCH);
}

uint countOf(SplatFrame frame, uint tile) {
    if (WordRef(frame.tileMask).v[tile] == 0u) return 0u;
#ifdef LANES
    return TileRef(frame.tiles).v[tile].count;
#else
    return WordRef(frame.histogram).v[tile];
#endif
}

// After how many merges the sorted batches of a list are one.
uint mergesOf(uint batches) { return batches > 1u ? uint(findMSB(batches - 1u)) + 1u : 0u; }

uint mostMerges() { return mergesOf((longest + SPLAT_BATCH - 1u) / SPLAT_BATCH); }

bool listsFit(SplatFrame frame) {
    const uvec2 end = sums[THREADS - 1u];
    return end.x <= frame.pairCapacity && end.y <= frame.batchCapacity && mostMerges() <= SPLAT_MERGES;
}

void writeState(SplatFrame frame) {
    StateRef state = StateRef(frame.state);
    const uvec2 end = sums[THREADS - 1u];
    const uint merges = mostMerges();
    const bool fits = listsFit(frame);
    state.v.pairs = totalPairs;
    state.v.pairsEnd = end.x;
    state.v.batches = end.y;
    state.v.largestList = longest;
    state.v.overflow = fits ? 0u : 1u;
    const uint batches = fits ? end.y : 0u, miniBatches = fits ? end.x / SPLAT_MINI_BATCH : 0u;
#ifdef LANES
    const uint groups = (batches + 7u) / 8u, tilesPerGroup = SPLAT_LANES_TILES; // a lane sorts a batch
#else
    const uint groups = batches, tilesPerGroup = 1u;
#endif
    state.v.sortGroups = uvec3(groups, 1u, 1u);
    for (uint i = 0u; i < SPLAT_MERGES; ++i)
        state.v.mergeGroups[i] = uvec3(i < merges ? groups : 0u, 1u, 1u);
    state.v.maskGroups = uvec3((miniBatches + 31u) / 32u, 1u, 1u);
    // 65535 workgroups in a row are all that every device takes.
    state.v.partialGroups = uvec3(32u / tilesPerGroup, min(batches, 32768u), (batches + 32767u) / 32768u);
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint tileCount = frame.tileColumns * frame.tileRows, each = (tileCount + THREADS - 1u) / THREADS;
    const uint first = min(gl_LocalInvocationIndex * each, tileCount), end = min(first + each, tileCount);
    if (gl_LocalInvocationIndex == 0u) {
        totalPairs = 0u;
        longest = 0u;
    }
    uvec2 own = uvec2(0u);
    uint pairs = 0u, most = 0u;
    for (uint tile = first; tile < end; ++tile) {
        const uint count = countOf(frame, tile);
        own += sizeOf(count);
        pairs += count;
        most = max(most, count);
    }
    uvec2 at = scan(own);
    atomicAdd(totalPairs, pairs);
    atomicMax(longest, most);
    barrier();
    if (gl_LocalInvocationIndex == 0u) writeState(frame);
    const bool fits = listsFit(frame); // else nothing is drawn, and the frame is done again with more room
    for (uint tile = first; tile < end; ++tile) {
        const uint count = countOf(frame, tile);
        const uvec2 size = sizeOf(count);
        TileRef(frame.tiles).v[tile] = SplatTile(at.x, fits ? count : 0u, at.y, mergesOf(size.y) & 1u);
        at += size;
#ifndef LANES
        WordRef(frame.histogram).v[tile] = 0u; // `fill` counts again
#endif
    }
}
