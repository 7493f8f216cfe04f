// Blends the splats of a list into a render tile of 8 x 8 pixels, front to back.
//
// Eight neighbouring lanes of a subgroup draw a tile; each holds a column of eight pixels. They load eight splats at a
// time, one each, and hand them to each other; there are no barriers and there is no shared memory. The subgroup may have
// any size from eight on. A workgroup draws eight tiles side by side.
#ifndef HIPR_HIGS_RASTER_GLSL
#define HIPR_HIGS_RASTER_GLSL
#include "higs/frame.glsl"
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require

layout(local_size_x = 64) in;

const uint LANES_PER_TILE = 8u, HEIGHT = 8u;

struct Column {
    float transmittance[HEIGHT];
    vec3 color[HEIGHT];
    uint median[HEIGHT]; // the splat that found a transmittance of 1/2 or more and was the last to do so
    float limit[HEIGHT]; // camera depth of what is opaque
    uvec2 blends;        // tried, done
};

// Which tile of the workgroup this lane belongs to, which of its columns, and the subgroup's first lane of the tile.
uint tileInGroup() { return (gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID) / LANES_PER_TILE; }
uint laneInTile() { return gl_SubgroupInvocationID % LANES_PER_TILE; }
uint firstLane() { return gl_SubgroupInvocationID - laneInTile(); }

float largestOfTile(float v) {
    v = max(v, subgroupShuffle(v, firstLane() + (laneInTile() ^ 1u)));
    v = max(v, subgroupShuffle(v, firstLane() + (laneInTile() ^ 2u)));
    return max(v, subgroupShuffle(v, firstLane() + (laneInTile() ^ 4u)));
}

Column emptyColumn(SplatFrame frame, uvec2 pixel) {
    Column column;
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y) {
        column.transmittance[y] = 1.0;
        column.color[y] = vec3(0.0);
        column.median[y] = NO_SPLAT;
        column.limit[y] = 3.402823466e38;
        if (frame.depthLimit != 0ul && pixel.x < frame.width && pixel.y + y < frame.height) {
            const float depth = FloatRef(frame.depthLimit).v[(pixel.y + y) * frame.width + pixel.x];
            if (depth > 0.0) column.limit[y] = depth;
        }
    }
    column.blends = uvec2(0u);
    return column;
}

float largestTransmittance(Column column) {
    float largest = 0.0;
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y)
        largest = max(largest, column.transmittance[y]);
    return largest;
}

// 2^-sigma for sigma in [0, 8): a polynomial for 2^(-sigma / 8), fitted to a relative error of 3e-6, squared three times.
float alphaOf(float sigma) {
    const float x = sigma * -0.125;
    float p = fma(x, fma(x, fma(x, fma(x, 0.00683189154, 0.0532235721), 0.239456741), 0.693063569), 1.0);
    p *= p;
    p *= p;
    return p * p;
}

// `d`: from the splat's mean to the middle of the column's first pixel.
void blend(inout Column column, vec2 d, vec3 shape, float bias, vec3 color, float depth, uint splat) {
    const float u = fma(shape.x, d.x, shape.y * d.y), v = shape.z * d.y;
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y) {
        const float uy = fma(shape.y, float(y), u), vy = fma(shape.z, float(y), v);
        const float sigma = fma(uy, uy, fma(vy, vy, bias));
        const bool touched = sigma < SPLAT_SIGMA_LIMIT && depth <= column.limit[y];
#ifdef COUNT_BLENDS
        ++column.blends.x;
        if (touched) ++column.blends.y;
#endif
        if (touched) {
            const float t = column.transmittance[y], weight = alphaOf(sigma) * t;
            column.color[y] = fma(vec3(weight), color, column.color[y]);
            if (t >= 0.5) column.median[y] = splat;
            column.transmittance[y] = max(t - weight, 0.0);
        }
    }
}

// Blends up to eight pairs: this lane's is `mine` if it is one of the first `count` lanes.
void blendEight(SplatFrame frame, PairRef pairs, uint mine, uint count, vec2 center, inout Column column) {
    uint splat = 0u;
    ProjectedSplat s = ProjectedSplat(vec2(0.0), vec3(0.0), 0.0, vec3(0.0), 0.0, 0.0);
    if (laneInTile() < count) {
        splat = pairs.v[mine].splat;
        s = loadSplat(frame, splat);
    }
    for (uint i = 0u; i < count; ++i) {
        const uint from = firstLane() + i;
        const vec2 d = center - subgroupShuffle(s.mean, from);
        blend(column, d, subgroupShuffle(s.shape, from), subgroupShuffle(s.bias, from), subgroupShuffle(s.color, from),
              subgroupShuffle(s.depth, from), subgroupShuffle(splat, from));
    }
}

// Blends the hits among `count` pairs from `first` on, of a list whose masks are known; `tile` is the bit's word.
void blendHits(SplatFrame frame, uint side, uint first, uint count, uint tile, vec2 center, inout Column column) {
    PairRef pairs = PairRef(frame.pairs[side]);
    WordRef masks = WordRef(frame.masks);
    const uint end = (count + SPLAT_MINI_BATCH - 1u) / SPLAT_MINI_BATCH;
    uint mini = 0u, word = 0u, words = 0u;
    bool more = true;
    while (more) {
        uint filled = 0u, mine = 0u;
        while (filled < LANES_PER_TILE && more) {
            if (word != 0u) {
                const uint hit = first + (mini - 1u) * SPLAT_MINI_BATCH + uint(findLSB(word));
                if (laneInTile() == filled) mine = hit;
                word &= word - 1u;
                ++filled;
            } else if (mini < end) {
                const uint next = mini % LANES_PER_TILE;
                if (next == 0u) {
                    words = 0u;
                    const uint own = mini + laneInTile();
                    if (own < end) words = masks.v[first + own * SPLAT_MINI_BATCH + tile];
                }
                word = subgroupShuffle(words, firstLane() + next);
                ++mini;
            } else
                more = false;
        }
        blendEight(frame, pairs, mine, filled, center, column);
        more = more && largestOfTile(largestTransmittance(column)) >= SPLAT_OPAQUE;
    }
}

// Blends all of `count` pairs from `first` on.
void blendAll(SplatFrame frame, uint side, uint first, uint count, vec2 center, inout Column column) {
    PairRef pairs = PairRef(frame.pairs[side]);
    for (uint i = 0u; i < count; i += LANES_PER_TILE) {
        blendEight(frame, pairs, first + i + laneInTile(), min(count - i, LANES_PER_TILE), center, column);
        if (largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE) break;
    }
}

// The placement a splat belongs to.
uint placementOf(SplatFrame frame, uint splat) {
    uint first = 0u, end = frame.placementCount;
    while (end - first > 1u) {
        const uint middle = (first + end) / 2u;
        if (PlacementRef(frame.placements).v[middle].first <= splat) first = middle;
        else end = middle;
    }
    return first;
}

SplatPixel pixelOf(SplatFrame frame, vec3 color, float transmittance, uint median) {
    SplatPixel pixel = SplatPixel(color, transmittance, 0.0, -1, -1, NO_SPLAT);
    if (transmittance >= 0.5 || median == NO_SPLAT) return pixel;
    const uint index = placementOf(frame, median);
    pixel.depth = loadSplat(frame, median).depth;
    pixel.primId = PlacementRef(frame.placements).v[index].primId;
    pixel.instanceId = PlacementRef(frame.placements).v[index].instanceId;
    pixel.splat = median - PlacementRef(frame.placements).v[index].first;
    return pixel;
}

void storeColumn(SplatFrame frame, uvec2 pixel, Column column) {
    for (uint y = 0u; y < HEIGHT; ++y) {
        const uvec2 at = pixel + uvec2(0u, y);
        if (any(lessThan(at, frame.cropLo)) || any(greaterThanEqual(at, frame.cropHi))) continue;
        PixelRef(frame.pixels).v[at.y * frame.width + at.x] =
            pixelOf(frame, column.color[y], column.transmittance[y], column.median[y]);
    }
}
#endif
