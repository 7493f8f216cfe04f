// Starts one path a slot. Workgroups: x covers the slots of a tile, y is the tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "trace/camera.glsl"
#include "trace/cone.glsl"
#include "sampling/sobol.glsl"
#include "sampling/filter.glsl"
#include "shared/reproject.h"

// The set of the time of a path, beside those of path.glsl.
const uint RANDOM_TIME = 0xfffeu;

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const TileWork tile = TileRef(trace.tiles).v[gl_WorkGroupID.y];
    const uint local = gl_GlobalInvocationID.x;
    if (gl_WorkGroupID.y == 0u && local == 0u) HeaderRef(trace.headers).v[QUEUE_RAYS].count = push.count;
    if (local >= tile.width * tile.height * tile.sampleCount) return;

    const uint pixelInTile = local / tile.sampleCount;
    const uvec2 pixel = uvec2(tile.x, tile.y) + tile.stride * uvec2(pixelInTile % tile.width, pixelInTile / tile.width);
    const uint slot = tile.firstSlot + local;

    PathState path;
    path.throughput = vec3(1.0);
    path.bsdfPdf = -1.0;
    path.radiance = vec3(0.0);
    path.event = 0u;
    path.indirect = vec3(0.0);
    path.depth = 0u;
    path.albedo = vec3(0.0);
    path.alpha = 0.0;
    path.pixel = pixel.x | pixel.y << 16;
    path.sampleIndex = tile.firstSample + local % tile.sampleCount;
    if (trace.pilot > 0u && path.sampleIndex >= trace.pilot)
        path.sampleIndex = (path.sampleIndex - trace.pilot) | SECOND_SAMPLE_SET;
    path.history = 0u;
    path.medium = MEDIUM_NONE;
    path.mediumColor = 0u;
    path.mediumRadius = 0u;
    path.categories = 0u;
    path.lightNormal = 0u;
    path.interiors = uvec2(0u);

    const vec4 u = sobol4(pixel, path.sampleIndex, 0u, trace.seed);
    const vec2 film = vec2(pixel) + 0.5 + sampleFilter(trace.pixelFilter, trace.filterWidth, u.xy);
    path.cone = cameraCone(CameraRef(trace.camera), film, uvec2(trace.width, trace.height));
    PathRef(trace.paths).v[slot] = path;
    PathSeenRef(trace.pathSeen).v[slot].look = SEEN_NOTHING;
    if (trace.lpe != 0ul) beginExpressions(trace.lpe, slot);
    if (trace.pathSlots != 0ul) SlotRef(trace.pathSlots).v[slot] = NO_INDEX;
    Ray ray = lensRay(CameraRef(trace.camera), film, uvec2(trace.width, trace.height), u.zw);
    if (trace.moving != 0u) {
        ray.time = sobol4(pixel, path.sampleIndex, RANDOM_TIME, trace.seed).x;
        ray = movedRay(trace, ray);
    }
    RayRef(trace.rays[0]).v[slot] = ray;
    SlotRef(trace.raySlots[0]).v[slot] = slot;
}
