// In lanes, modes with macro-tiles: blends those of a list that hit the tile, eight at a time.
#ifndef HIPR_HIGS_BLEND_HITS_GLSL
#define HIPR_HIGS_BLEND_HITS_GLSL

const uint RUN = HEIGHT / 2u; // rows

// A splat as the columns of a tile see it. Let u be along.x times the column plus along.y; in its row y sigma is
// u^2 + start + y (slope.x u + slope.y) + y (y - 1) curve.
struct Listed {
    vec2 along;
    float start;
    vec2 slope;
    float curve;
    vec2 bend; // how the ratio of neighbouring rows' alphas changes in a row, and in a run
    vec3 color;
    float depth;
    uint splat;
};

// `center`: of this lane's first pixel.
Listed listedOf(uint splat, ProjectedSplat s, vec2 center) {
    const vec2 d = vec2(center.x - float(laneInTile()), center.y) - s.mean;
    const float v = s.shape.z * d.y;
    Listed l;
    l.along = vec2(s.shape.x, fma(s.shape.x, d.x, s.shape.y * d.y));
    l.start = fma(v, v, s.bias);
    l.curve = fma(s.shape.y, s.shape.y, s.shape.z * s.shape.z);
    l.slope = vec2(2.0 * s.shape.y, fma(2.0 * s.shape.z, v, l.curve));
    l.bend = exp2(-2.0 * l.curve * vec2(1.0, float(RUN)));
    l.color = s.color;
    l.depth = s.depth;
    l.splat = splat;
    return l;
}

Listed shuffled(Listed l, uint from) {
    l.along = subgroupShuffle(l.along, from);
    l.start = subgroupShuffle(l.start, from);
    l.slope = subgroupShuffle(l.slope, from);
    l.curve = subgroupShuffle(l.curve, from);
    l.bend = subgroupShuffle(l.bend, from);
    l.color = subgroupShuffle(l.color, from);
    l.depth = subgroupShuffle(l.depth, from);
    l.splat = subgroupShuffle(l.splat, from);
    return l;
}

// A splat in a column: sigma of its first row, and by how much it grows to the next.
struct Falloff {
    float start, slope;
};

Falloff falloffOf(Listed l) {
    const float x = float(laneInTile()), u = fma(l.along.x, x, l.along.y);
    return Falloff(fma(u, u, l.start), fma(l.slope.x, u, l.slope.y));
}

// Blends a splat into a run of rows. Since sigma is a quadratic polynomial of the row, the ratios of neighbouring rows'
// alphas are a geometric sequence: two multiplications take the place of an exponential. Each run begins anew. Where a splat
// that is as small as the dilation lets it be is seen within a run, alpha is above 2^-120 at its begin, and the ratio below
// 2^120.
void blendRun(inout Column column, uint run, Listed l, Falloff falloff) {
    const float y = float(run * RUN);
    float alpha = exp2(-fma(y, falloff.slope, fma(y * (y - 1.0), l.curve, falloff.start)));
    float ratio = exp2(min(-falloff.slope, 120.0));
    if (run == 1u) ratio *= l.bend.y;
    [[unroll]] for (uint k = 0u; k < RUN; ++k) {
        blendPixel(column, run * RUN + k, alpha >= SPLAT_LEAST_ALPHA, alpha, l.color, l.depth, l.splat);
        alpha *= ratio;
        ratio *= l.bend.x;
    }
}

// Blends eight splats, of which each lane has one: all into one run of rows after another, so that what rows have gathered
// stays in registers.
void blendEight(Listed mine, inout Column column) {
    Listed all[LANES_PER_TILE];
    Falloff falloffs[LANES_PER_TILE];
    [[unroll]] for (uint i = 0u; i < LANES_PER_TILE; ++i) {
        all[i] = shuffled(mine, firstLane() + i);
        falloffs[i] = falloffOf(all[i]);
    }
    [[unroll]] for (uint run = 0u; run < HEIGHT / RUN; ++run)
        [[unroll]] for (uint i = 0u; i < LANES_PER_TILE; ++i)
            blendRun(column, run, all[i], falloffs[i]);
}

const uint LISTED = LANES_PER_TILE * SPLAT_MINI_BATCH; // pairs whose hits are listed at once

uint beforeInTile(uint v) {
    uint sum = v;
    [[unroll]] for (uint step_ = 1u; step_ < LANES_PER_TILE; step_ *= 2u) {
        const uint other = subgroupShuffle(sum, firstLane() + ((laneInTile() - step_) & 7u));
        if (laneInTile() >= step_) sum += other;
    }
    return sum - v;
}

// Hits of eight mini-batches; each lane has the word of one.
struct Hits {
    uint word;
    uint before; // in the words of the lanes before
    uint all;
};

Hits hitsOf(uint word) {
    const uint own = uint(bitCount(word)), before = beforeInTile(own);
    return Hits(word, before, subgroupShuffle(before + own, firstLane() + LANES_PER_TILE - 1u));
}

// The place of hit number `n` among the pairs.
uint placeOf(Hits hits, uint n) {
    uint lane = 0u;
    [[unroll]] for (uint i = 1u; i < LANES_PER_TILE; ++i)
        lane += n >= subgroupShuffle(hits.before, firstLane() + i) ? 1u : 0u;
    uint word = subgroupShuffle(hits.word, firstLane() + lane);
    uint rest = n - subgroupShuffle(hits.before, firstLane() + lane);
    uint place = lane * SPLAT_MINI_BATCH;
    [[unroll]] for (uint size = SPLAT_MINI_BATCH / 2u; size > 0u; size /= 2u) {
        const uint below = uint(bitCount(word & ((1u << size) - 1u)));
        const bool above = rest >= below;
        rest -= above ? below : 0u;
        word >>= above ? size : 0u;
        place += above ? size : 0u;
    }
    return place;
}

// Blends the hits among `count` pairs from `first` on, of a list whose masks are known; `tile` is the bit's word. Those of
// eight mini-batches that make no eight wait for those of the next.
//
// A CPU walks through all that follows a jump out of a loop, if only to do nothing, but skips an `if` that no lane takes:
// hence the loops that test at their ends.
void blendHits(SplatFrame frame, uint64_t pairs, uint first, uint count, uint tile, vec2 center, inout Column column) {
    if (count == 0u) return;
    WordRef masks = WordRef(frame.masks);
    ProjectedSplat s = NOTHING;
    uint splat = 0u, waiting = 0u, base = 0u; // so many lanes have a splat; `base` pairs have been looked at
    bool opaque = false;
    do {
        const uint own = base + laneInTile() * SPLAT_MINI_BATCH;
        const Hits hits = hitsOf(own < count ? masks.v[first + own + tile] : 0u);
        const bool last = base + LISTED >= count;
        uint taken = 0u;
        if (hits.all > 0u || (last && waiting > 0u)) do {
            if (laneInTile() >= waiting) {
                s.bias = NO_BIAS; // what else a lane may hold is left of a splat
                const uint n = taken + laneInTile() - waiting, place = placeOf(hits, n);
                if (n < hits.all) {
                    splat = pairSplat(pairs, first + base + place);
                    s = loadSplat(frame, splat);
                }
            }
            const uint more = min(LANES_PER_TILE - waiting, hits.all - taken);
            taken += more;
            waiting += more;
            if (waiting == LANES_PER_TILE || last) {
                blendEight(listedOf(splat, s, center), column);
                opaque = largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE;
                waiting = 0u;
            }
        } while (taken < hits.all && !opaque);
        base += LISTED;
    } while (base < count && !opaque);
}
#endif
