// Which render tiles of a macro-tile each pair of its list hits, as bits of words: for each mini-batch of 32 pairs one
// word a render tile. One invocation a mini-batch: a word a pair first, and then the 32 x 32 bits transposed.
#ifndef HIPR_HIGS_MASKS_GLSL
#define HIPR_HIGS_MASKS_GLSL
#include "higs/frame.glsl"

// A tile is hit where the ellipse meets the rectangle between the centres of its outermost pixels.
uint hits(ProjectedSplat s, vec2 corner) {
    const SplatEllipse e = splatEllipse(s.mean - corner, s.shape, splatReach(s.bias));
    const float size = float(SPLAT_TILE);
    uint bits = 0u;
    [[unroll]] for (uint row = 0u; row < SPLAT_MACRO_HEIGHT / SPLAT_TILE; ++row) {
        const float lo = float(row) * size + 0.5, hi = lo + size - 1.0;
        const vec2 span = ellipseSpan(e, lo, hi);
        const float from = clamp(ceil((span.x + 0.5) / size - 1.0), 0.0, float(SPLAT_MACRO_WIDTH / SPLAT_TILE));
        const float to = clamp(floor((span.y - 0.5) / size) + 1.0, 0.0, float(SPLAT_MACRO_WIDTH / SPLAT_TILE));
        const bool meets = lo <= e.mean.y + e.half_.y && hi >= e.mean.y - e.half_.y && from < to;
        if (meets) bits |= ((1u << uint(to)) - (1u << uint(from))) << (row * (SPLAT_MACRO_WIDTH / SPLAT_TILE));
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

// Writes the masks of the mini-batch that begins with pair `first` of the list of a macro-tile.
void writeMasks(SplatFrame frame, uint index, SplatTile tile, uint first) {
    const vec2 corner = vec2(index % frame.tileColumns * SPLAT_MACRO_WIDTH, index / frame.tileColumns * SPLAT_MACRO_HEIGHT);
    const uint64_t pairs = sortedPairs(frame, tile.side);
    WordRef masks = WordRef(frame.masks);
    const uint count = min(tile.first + tile.count - first, SPLAT_MINI_BATCH);
    const uint at = 2u; // pairs whose splats, which may be anywhere in memory, are asked for at once
    uint i = 0u;
    do {
        uint splats[at];
        ProjectedSplat s[at];
        [[unroll]] for (uint k = 0u; k < at; ++k)
            splats[k] = pairSplat(pairs, first + min(i + k, count - 1u));
        [[unroll]] for (uint k = 0u; k < at; ++k)
            s[k] = loadSplat(frame, splats[k]);
        [[unroll]] for (uint k = 0u; k < at; ++k)
            masks.v[first + i + k] = i + k < count ? hits(s[k], corner) : 0u;
        i += at;
    } while (i < SPLAT_MINI_BATCH);
    uint rows[32];
    [[unroll]] for (uint i = 0u; i < 32u; ++i)
        rows[i] = masks.v[first + i];
    transpose32(rows);
    [[unroll]] for (uint i = 0u; i < 32u; ++i)
        masks.v[first + i] = rows[i];
}
#endif
