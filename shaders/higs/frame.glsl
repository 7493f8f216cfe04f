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
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PairRef { SplatPair v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PartialRef { SplatPartial v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer PixelRef { SplatPixel v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CameraRef { CameraRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer WordRef { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer FloatRef { float v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Vec3Ref { vec3 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer Uvec4Ref { uvec4 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer Uvec2Ref { uvec2 v[]; };

layout(push_constant, scalar) uniform Push { SplatPush push; };

#ifdef HALF_RECORDS
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SplatRef { ProjectedSplatHalf v[]; };

ProjectedSplat loadSplat(SplatFrame frame, uint i) {
    const ProjectedSplatHalf packed = SplatRef(frame.splats).v[i];
    const vec2 shapeXY = unpackHalf2x16(packed.shapeXY), shapeZBias = unpackHalf2x16(packed.shapeZBias);
    const vec2 colorRG = unpackHalf2x16(packed.colorRG);
    return ProjectedSplat(packed.mean, vec3(shapeXY, shapeZBias.x), shapeZBias.y,
                          vec3(colorRG, unpackHalf2x16(packed.colorB).x), packed.depth, packed.key);
}

void storeSplat(SplatFrame frame, uint i, ProjectedSplat s) {
    // Beyond halves' largest value there is nothing to tell apart, and infinities would make colours undefined.
    const vec3 color = min(s.color, vec3(65504.0));
    SplatRef(frame.splats).v[i] =
        ProjectedSplatHalf(s.mean, s.depth, s.key, packHalf2x16(s.shape.xy), packHalf2x16(vec2(s.shape.z, s.bias)),
                           packHalf2x16(color.rg), packHalf2x16(vec2(color.b, 0.0)));
}

float loadBias(SplatFrame frame, uint i) {
    return unpackHalf2x16(SplatRef(frame.splats).v[i].shapeZBias).y;
}
#else
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SplatRef { ProjectedSplat v[]; };

ProjectedSplat loadSplat(SplatFrame frame, uint i) { return SplatRef(frame.splats).v[i]; }
void storeSplat(SplatFrame frame, uint i, ProjectedSplat s) { SplatRef(frame.splats).v[i] = s; }
float loadBias(SplatFrame frame, uint i) { return SplatRef(frame.splats).v[i].bias; }
#endif

// Of a grid that may be wider than one row of workgroups.
uint workgroupIndex() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }
// (gl_WorkGroupSize is not known where this is declared.)
uint invocationIndex(uint groupSize) { return workgroupIndex() * groupSize + gl_LocalInvocationIndex; }

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
