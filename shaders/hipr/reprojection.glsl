// What the kernels of reprojection share.
#ifndef HIPR_HIPR_REPROJECTION_GLSL
#define HIPR_HIPR_REPROJECTION_GLSL
#include "shared/references.glsl"
#include "shared/reproject.h"

layout(local_size_x = 64) in;

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer CameraRef { CameraRecord v; };
layout(buffer_reference, scalar, buffer_reference_align = 8) buffer PairRef { uint64_t v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer ListRef { uint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer CountsRef { CarriedCounts v; };

layout(push_constant, scalar) uniform Push { ReprojectionPush push; };

ListRef list(uint which) {
    return ListRef(push.lists + uint64_t(4u) * which * push.width * push.height);
}

// Records are read and written as pairs of words: each access of a lane costs a CPU device as much as a word does.
vec2 floatsOf(uint64_t pair) { return uintBitsToFloat(unpack32(pair)); }
uint64_t pairOf(float a, float b) { return pack64(floatBitsToUint(vec2(a, b))); }

SeenPoint seenAt(uint pixel) {
    PairRef pairs = PairRef(push.seen + uint64_t(16u) * pixel);
    const uvec2 end = unpack32(pairs.v[1]);
    return SeenPoint(vec3(floatsOf(pairs.v[0]), uintBitsToFloat(end.x)), end.y);
}

void keepSeen(uint pixel, SeenPoint seen) {
    PairRef pairs = PairRef(push.seenAfter + uint64_t(16u) * pixel);
    pairs.v[0] = pairOf(seen.point.x, seen.point.y);
    pairs.v[1] = pack64(uvec2(floatBitsToUint(seen.point.z), seen.look));
}

// The mean of an OldPixel, or of a FilmPixel.
OldPixel meanAt(uint64_t address) {
    PairRef pairs = PairRef(address);
    const vec4 color = vec4(floatsOf(pairs.v[0]), floatsOf(pairs.v[1]));
    const uvec2 end = unpack32(pairs.v[3]);
    const vec3 albedo = vec3(floatsOf(pairs.v[2]), uintBitsToFloat(end.x));
    const float weight = 1.0 / float(max(end.y, 1u));
    return OldPixel(color * weight, albedo * weight, 1u);
}

uint64_t carriedAddress(uint pixel) { return push.carried + uint64_t(32u) * pixel; }

void carryTo(uint pixel, OldPixel old) {
    PairRef pairs = PairRef(carriedAddress(pixel));
    pairs.v[0] = pairOf(old.color.r, old.color.g);
    pairs.v[1] = pairOf(old.color.b, old.color.a);
    pairs.v[2] = pairOf(old.albedo.r, old.albedo.g);
    pairs.v[3] = pack64(uvec2(floatBitsToUint(old.albedo.b), 1u));
}

// What is on display in a pixel, given as x | y << 16.
OldPixel displayed(uint packed_) {
    const uint x = packed_ & 0xffffu, y = packed_ >> 16u, pixel = x + y * push.width;
    const uint tile = (x >> push.tileShift) + (y >> push.tileShift) * push.tileColumns;
    const bool keepsOld = UintRef(push.tileKeepsOld).v[tile] != 0u;
    return meanAt(keepsOld ? push.oldPicture + uint64_t(32u) * pixel : push.film + uint64_t(56u) * pixel);
}
#endif
