// Which render tiles of a macro-tile each pair of its list hits, as bits of words: for each mini-batch of 32 pairs one
// word a render tile. One invocation a mini-batch: a word a pair first, and then the 32 x 32 bits transposed.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"

layout(local_size_x = 32) in;

const uint COLUMNS = SPLAT_MACRO_WIDTH / SPLAT_TILE, ROWS = SPLAT_MACRO_HEIGHT / SPLAT_TILE;

// A tile is hit where the ellipse meets the rectangle between the centres of its outermost pixels.
uint hits(SplatFrame frame, uint splat, vec2 corner) {
    const ProjectedSplat s = loadSplat(frame, splat);
    const SplatEllipse e = splatEllipse(s.mean - corner, s.shape, splatReach(s.bias));
    const float size = float(SPLAT_TILE);
    uint bits = 0u;
    [[unroll]] for (uint row = 0u; row < ROWS; ++row) {
        const float lo = float(row) * size + 0.5, hi = lo + size - 1.0;
        const vec2 span = ellipseSpan(e, lo, hi);
        const float from = clamp(ceil((span.x + 0.5) / size - 1.0), 0.0, float(COLUMNS));
        const float to = clamp(floor((span.y - 0.5) / size) + 1.0, 0.0, float(COLUMNS));
        const bool meets = lo <= e.mean.y + e.half_.y && hi >= e.mean.y - e.half_.y && from < to;
        if (meets) bits |= ((1u << uint(to)) - (1u << uint(from))) << (row * COLUMNS);
    }
    return bits;
}

// H. Warren, "Hacker's Delight", section 7-3: swaps blocks of halving size.
void transpose32(inout uint rows[32]) {
    uint mask = 0x0000ffffu;
    [[unroll]] for (uint size = 16u; size != 0u; size >>= 1u) {
        [[unroll]] for (uint k = 0u; k < 32u; ++k) {
            if ((k & size) != 0u) continue;
            const uint swapped = ((rows[k] >> size) ^ rows[k + size]) & mask;
            rows[k] ^= swapped << size;
            rows[k + size] ^= swapped;
        }
        mask ^= mask << (size >> 1u);
    }
}

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    const uint first = invocationIndex(gl_WorkGroupSize.x) * SPLAT_MINI_BATCH;
    if (first >= StateRef(frame.state).v.pairsEnd) return;
    const uint index = tileOfPair(frame, first);
    const SplatTile tile = TileRef(frame.tiles).v[index];
    const vec2 corner = vec2(index % frame.tileColumns * SPLAT_MACRO_WIDTH, index / frame.tileColumns * SPLAT_MACRO_HEIGHT);
    WordRef masks = WordRef(frame.masks);
    const uint count = min(tile.first + tile.count - first, SPLAT_MINI_BATCH);
    for (uint i = 0u; i < SPLAT_MINI_BATCH; ++i)
        masks.v[first + i] = i < count ? hits(frame, pairSplat(frame, tile.side, first + i), corner) : 0u;
    uint rows[32];
    [[unroll]] for (uint i = 0u; i < 32u; ++i)
        rows[i] = masks.v[first + i];
    transpose32(rows);
    [[unroll]] for (uint i = 0u; i < 32u; ++i)
        masks.v[first + i] = rows[i];
}
