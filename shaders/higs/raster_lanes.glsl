// Eight neighbouring lanes of a subgroup draw a tile; each holds a column of eight pixels. They load eight splats at a
// time, one each, and hand them to each other; there are no barriers of the workgroup. The subgroup may have
// any size from eight on. A workgroup draws 32 tiles: side by side, or a macro-tile.
#ifndef HIPR_HIGS_RASTER_LANES_GLSL
#define HIPR_HIGS_RASTER_LANES_GLSL
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "higs/frame.glsl"
const uint HEIGHT = 8u, TILES_PER_GROUP = SPLAT_LANES_TILES;
#include "higs/raster.glsl"

layout(local_size_x = 256) in;

const uint LANES_PER_TILE = 8u;

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

// A splat that touches nothing.
const float NO_BIAS = 2.0 * SPLAT_SIGMA_LIMIT;
const ProjectedSplat NOTHING = ProjectedSplat(vec2(0.0), vec3(0.0), NO_BIAS, vec3(0.0), 0.0);

#ifdef FLAT
#include "higs/blend_all.glsl"
#else
#include "higs/blend_hits.glsl"
#endif
#endif
