// Eight neighbouring lanes of a subgroup draw a tile; each holds a column of eight pixels. They load eight splats at a
// time, one each, and hand them to each other; there are no barriers of the workgroup. The subgroup may have
// any size from eight on. A workgroup draws eight tiles side by side.
#ifndef HIPR_HIGS_RASTER_LANES_GLSL
#define HIPR_HIGS_RASTER_LANES_GLSL
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
const uint HEIGHT = 8u;
#include "higs/raster.glsl"

layout(local_size_x = 64) in;

const uint TILES_PER_GROUP = 8u, LANES_PER_TILE = 8u;
const uint QUEUE = LANES_PER_TILE * SPLAT_MINI_BATCH;

shared uint queues[TILES_PER_GROUP * QUEUE]; // of each tile: the lanes of a tile hand it on among themselves

// Which tile of the workgroup this lane belongs to, which of its columns, and the subgroup's first lane of the tile.
uint tileInGroup() { return (gl_SubgroupID * gl_SubgroupSize + gl_SubgroupInvocationID) / LANES_PER_TILE; }
uint laneInTile() { return gl_SubgroupInvocationID % LANES_PER_TILE; }
uint firstLane() { return gl_SubgroupInvocationID - laneInTile(); }

uvec2 pixelInTile() { return uvec2(laneInTile(), 0u); }

float largestOfTile(float v) {
    v = max(v, subgroupShuffle(v, firstLane() + (laneInTile() ^ 1u)));
    v = max(v, subgroupShuffle(v, firstLane() + (laneInTile() ^ 2u)));
    return max(v, subgroupShuffle(v, firstLane() + (laneInTile() ^ 4u)));
}

// Blends up to eight pairs: this lane's is `mine` if it is one of the first `count` lanes.
void blendEight(SplatFrame frame, uint side, uint mine, uint count, vec2 center, inout Column column) {
    uint splat = 0u;
    ProjectedSplat s = ProjectedSplat(vec2(0.0), vec3(0.0), 0.0, vec3(0.0), 0.0, 0.0, 0u);
    if (laneInTile() < count) {
        splat = pairSplat(frame, side, mine);
        s = loadSplat(frame, splat);
    }
    for (uint i = 0u; i < count; ++i) {
        const uint from = firstLane() + i;
        const vec2 d = center - subgroupShuffle(s.mean, from);
        blend(column, d, subgroupShuffle(s.shape, from), subgroupShuffle(s.bias, from), subgroupShuffle(s.color, from),
              subgroupShuffle(s.depth, from), subgroupShuffle(splat, from));
    }
}

uint beforeInTile(uint v) {
    uint sum = v;
    [[unroll]] for (uint step_ = 1u; step_ < LANES_PER_TILE; step_ *= 2u) {
        const uint other = subgroupShuffle(sum, firstLane() + ((laneInTile() - step_) & 7u));
        if (laneInTile() >= step_) sum += other;
    }
    return sum - v;
}

// Blends the hits among `count` pairs from `first` on, of a list whose masks are known; `tile` is the bit's word. Eight
// mini-batches at a time, each lane lists the hits of one; a CPU runs both sides of a branch, so that these loops, rather
// than conditions within one loop, decide what is done how often.
void blendHits(SplatFrame frame, uint side, uint first, uint count, uint tile, vec2 center, inout Column column) {
    WordRef masks = WordRef(frame.masks);
    const uint queue = tileInGroup() * QUEUE;
    for (uint base = 0u; base < count; base += QUEUE) {
        const uint own = base + laneInTile() * SPLAT_MINI_BATCH;
        uint word = own < count ? masks.v[first + own + tile] : 0u;
        const uint hits = uint(bitCount(word)), before = beforeInTile(hits);
        for (uint place = queue + before; word != 0u; ++place) {
            queues[place] = first + own + uint(findLSB(word));
            word &= word - 1u;
        }
        // The shuffle brings the lanes together, so that all hits are listed. A barrier of the subgroup would say the
        // same, but lavapipe makes one of the workgroup of it, whose other tiles may have gone already.
        subgroupMemoryBarrierShared();
        const uint all = subgroupShuffle(before + hits, firstLane() + LANES_PER_TILE - 1u);
        for (uint i = 0u; i < all; i += LANES_PER_TILE) {
            const uint mine = i + laneInTile() < all ? queues[queue + i + laneInTile()] : 0u;
            blendEight(frame, side, mine, min(all - i, LANES_PER_TILE), center, column);
            if (largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE) return;
        }
    }
}

// Blends all of `count` pairs from `first` on.
void blendAll(SplatFrame frame, uint side, uint first, uint count, vec2 center, inout Column column) {
    for (uint i = 0u; i < count; i += LANES_PER_TILE) {
        blendEight(frame, side, first + i + laneInTile(), min(count - i, LANES_PER_TILE), center, column);
        if (largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE) break;
    }
}
#endif
