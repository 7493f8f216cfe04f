// Adds what the samples of a batch brought along the paths of each light path expression to the film; one pixel an
// invocation and its samples in order. Behind `resolve`, with its workgroups.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "film/sum.glsl"
#include "trace/wavefront.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer LpePixelRef { LpePixel v[]; };

void main() {
    TraceRecordRef trace = TraceRecordRef(push.record);
    const LpeRecord lpe = LpeRef(trace.v.lpe).v;
    const TileWork tile = TileRef(trace.v.tiles).v[gl_WorkGroupID.y];
    const uint local = gl_GlobalInvocationID.x;
    if (local >= tile.width * tile.height) return;
    const uint pixel = tile.x + local % tile.width + (tile.y + local / tile.width) * trace.v.width;
    const bool anew = tile.firstSample == 0u || tile.firstSample == trace.v.pilot;
    LpePixelRef film = LpePixelRef(lpe.film);
    for (uint k = 0u; k < lpe.count; ++k) {
        LpePixel sum = LpePixel(vec3(0.0), vec3(0.0));
        if (!anew) sum = film.v[pixel * lpe.count + k];
        for (uint i = 0u; i < tile.sampleCount; ++i) {
            const uint slot = tile.firstSlot + local * tile.sampleCount + i;
            addTo(sum.sum, sum.error, LpeSumRef(lpe.sums).v[slot * lpe.count + k]);
        }
        film.v[pixel * lpe.count + k] = sum;
    }
}
