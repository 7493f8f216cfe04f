// What the kernels of the splat pass share: the buffers behind SplatFrame.
#ifndef HIPR_HIGS_FRAME_GLSL
#define HIPR_HIGS_FRAME_GLSL
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_buffer_reference_uvec2 : enable
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require
#include "shared/higs.h"
#include "shared/higs_ellipse.h"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FrameRef { SplatFrame v; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer StateRef { SplatState v; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer PlacementRef { SplatPlacement v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer BlockRef { SplatBlock v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer RayRef { SplatRay v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TileRef { SplatTile v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PairRef { uint64_t v[]; }; // SplatPair
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TilePairRef { SplatTilePair v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CameraRef { CameraRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer WordRef { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FloatRef { float v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vec3Ref { vec3 v[]; };
// A CPU reads and writes memory lane by lane, which costs as much for eight bytes as for four: what kernels do most is
// done by pairs of words.
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer DoubleRef { uint64_t v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Uvec2Ref { uvec2 v[]; };

layout(push_constant, scalar) uniform Push { SplatPush push; };

vec2 loadPair(uint64_t address, uint i) { return uintBitsToFloat(unpackUint2x32(DoubleRef(address).v[i])); }
void storePair(uint64_t address, uint i, vec2 v) { DoubleRef(address).v[i] = packUint2x32(floatBitsToUint(v)); }

#ifdef HALF_RECORDS
ProjectedSplat loadSplat(SplatFrame frame, uint i) {
    const uvec2 shape = unpackUint2x32(DoubleRef(frame.splats).v[4u * i + 1u]);
    const uvec2 color = unpackUint2x32(DoubleRef(frame.splats).v[4u * i + 2u]);
    const vec2 shapeZBias = unpackHalf2x16(shape.y);
    return ProjectedSplat(loadPair(frame.splats, 4u * i), vec3(unpackHalf2x16(shape.x), shapeZBias.x), shapeZBias.y,
                          vec3(unpackHalf2x16(color.x), unpackHalf2x16(color.y).x), loadPair(frame.splats, 4u * i + 3u).x);
}

void storeSplat(SplatFrame frame, uint i, ProjectedSplat s) {
    // Beyond halves' largest value there is nothing to tell apart, and infinities would make colours undefined.
    const vec3 color = min(s.color, vec3(65504.0));
    storePair(frame.splats, 4u * i, s.mean);
    DoubleRef(frame.splats).v[4u * i + 1u] =
        packUint2x32(uvec2(packHalf2x16(s.shape.xy), packHalf2x16(vec2(s.shape.z, s.bias))));
    DoubleRef(frame.splats).v[4u * i + 2u] =
        packUint2x32(uvec2(packHalf2x16(color.rg), packHalf2x16(vec2(color.b, 0.0))));
    storePair(frame.splats, 4u * i + 3u, vec2(s.depth, 0.0));
}
#else
ProjectedSplat loadSplat(SplatFrame frame, uint i) {
    const vec2 shapeXY = loadPair(frame.splats, 5u * i + 1u), shapeZBias = loadPair(frame.splats, 5u * i + 2u);
    const vec2 colorRG = loadPair(frame.splats, 5u * i + 3u), colorBDepth = loadPair(frame.splats, 5u * i + 4u);
    return ProjectedSplat(loadPair(frame.splats, 5u * i), vec3(shapeXY, shapeZBias.x), shapeZBias.y,
                          vec3(colorRG, colorBDepth.x), colorBDepth.y);
}

void storeSplat(SplatFrame frame, uint i, ProjectedSplat s) {
    storePair(frame.splats, 5u * i, s.mean);
    storePair(frame.splats, 5u * i + 1u, s.shape.xy);
    storePair(frame.splats, 5u * i + 2u, vec2(s.shape.z, s.bias));
    storePair(frame.splats, 5u * i + 3u, s.color.rg);
    storePair(frame.splats, 5u * i + 4u, vec2(s.color.b, s.depth));
}
#endif

SplatReach loadReach(SplatFrame frame, uint i) {
    const uvec2 words = unpackUint2x32(DoubleRef(frame.reaches).v[i]);
    return SplatReach(words.x, uintBitsToFloat(words.y));
}
void storeReach(SplatFrame frame, uint i, SplatReach reach) {
    DoubleRef(frame.reaches).v[i] = packUint2x32(uvec2(reach.tiles, floatBitsToUint(reach.key)));
}

// A pixel, and a batch's part of one, in memory.
void storePixel(SplatFrame frame, uint i, SplatPixel pixel) {
    storePair(frame.pixels, 4u * i, pixel.color.rg);
    storePair(frame.pixels, 4u * i + 1u, vec2(pixel.color.b, pixel.transmittance));
    DoubleRef(frame.pixels).v[4u * i + 2u] = packUint2x32(uvec2(floatBitsToUint(pixel.depth), uint(pixel.primId)));
    DoubleRef(frame.pixels).v[4u * i + 3u] = packUint2x32(uvec2(uint(pixel.instanceId), pixel.splat));
}
uint loadPixelSplat(SplatFrame frame, uint i) { return WordRef(frame.pixels).v[8u * i + 7u]; }
void storePixelMedian(SplatFrame frame, uint i, float depth, int primId, int instanceId, uint splat) {
    DoubleRef(frame.pixels).v[4u * i + 2u] = packUint2x32(uvec2(floatBitsToUint(depth), uint(primId)));
    DoubleRef(frame.pixels).v[4u * i + 3u] = packUint2x32(uvec2(uint(instanceId), splat));
}
void storePartial(SplatFrame frame, uint i, SplatPartial part) {
    storePair(frame.partials, 2u * i, part.color.rg);
    storePair(frame.partials, 2u * i + 1u, vec2(part.color.b, part.transmittance));
}
SplatPartial loadPartial(SplatFrame frame, uint i) {
    const vec2 blueT = loadPair(frame.partials, 2u * i + 1u);
    return SplatPartial(vec3(loadPair(frame.partials, 2u * i), blueT.x), blueT.y);
}

uint64_t packPair(uint key, uint splat) { return packUint2x32(uvec2(splat, key)); }

// Of a grid that may be wider than one row of workgroups.
uint workgroupIndex() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
// (gl_WorkGroupSize is not known where this is declared.)
uint invocationIndex(uint groupSize) { return workgroupIndex() * groupSize + gl_LocalInvocationIndex; }

// Where a tile's sorted list is.
uint64_t sortedPairs(SplatFrame frame, uint side) {
#ifdef FLAT
    return frame.tilePairs[side];
#else
    return frame.pairs[side];
#endif
}

// The splat of a pair in a sorted list.
uint pairSplat(uint64_t pairs, uint pair) {
#ifdef FLAT
    return TilePairRef(pairs).v[pair].splat;
#else
    return WordRef(pairs).v[2u * pair];
#endif
}

// The tile whose list holds a pair, or a batch: the last that starts at or before it, lists without pairs being empty.
uint tileOfPair(SplatFrame frame, uint pair) {
    TileRef tiles = TileRef(frame.tiles);
    uint first = 0u, end = frame.tileColumns * frame.tileRows;
    while (end - first > 1u) {
        const uint middle = (first + end) / 2u;
        if (tiles.v[middle].first <= pair) first = middle;
        else end = middle;
    }
    return first;
}

uint tileOfBatch(SplatFrame frame, uint batch) {
    TileRef tiles = TileRef(frame.tiles);
    uint first = 0u, end = frame.tileColumns * frame.tileRows;
    while (end - first > 1u) {
        const uint middle = (first + end) / 2u;
        if (tiles.v[middle].firstBatch <= batch) first = middle;
        else end = middle;
    }
    return first;
}
#endif
