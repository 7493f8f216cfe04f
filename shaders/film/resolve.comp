// Adds a batch's samples to the film, one pixel an invocation and its samples in order, so that sums round alike
// however samples were spread over batches. Workgroups: x covers the pixels of a tile, y is the tile.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "film/sum.glsl"
#include "trace/wavefront.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) buffer FirstSampleRef { vec3 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer OldPictureRef { OldPixel v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer SpreadRef { vec3 v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) writeonly buffer SeenRef { SeenPoint v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 4) buffer TileChangeRef { TileChange v[]; };

// Steps of gpu::TileChange: the mean over the channels of |a - b|.
uint changeSteps(TraceRecord trace, vec3 a, vec3 b) {
    return uint(min(dot(abs(a - b), vec3(trace.changeScale / 3.0)), MAX_PIXEL_CHANGE));
}

// Keeps a pixel's sample 0 for comparisons to come, and compares it with the one it replaces.
void replaceFirstSample(TraceRecord trace, uint pixel, vec3 radiance) {
    if (trace.changeScale > 0.0) {
        const uint change = changeSteps(trace, radiance, FirstSampleRef(trace.firstSamples).v[pixel]);
        if (change > 0u) atomicAdd(TileChangeRef(trace.tileChanges).v[gl_WorkGroupID.y].change, change);
    }
    FirstSampleRef(trace.firstSamples).v[pixel] = radiance;
}

// Looks at the picture on display before a pixel's sample 0 takes its place in the film.
void retire(TraceRecord trace, uint flags, uint pixel, vec3 radiance) {
    if (flags == 0u) return;
    OldPictureRef oldPicture = OldPictureRef(trace.oldPicture);
    vec3 old;
    if ((flags & TILE_SAVES_OLD) != 0u) {
        const FilmPixel shown = FilmRef(trace.film).v[pixel];
        const float weight = 1.0 / float(max(shown.count, 1u));
        oldPicture.v[pixel] = OldPixel(shown.color * weight, shown.albedo * weight, 1u);
        old = shown.color.rgb * weight;
    } else {
        old = oldPicture.v[pixel].color.rgb;
    }
    if (trace.changeScale == 0.0) return;
    const uint noise = changeSteps(trace, radiance, old);
    if (noise > 0u) atomicAdd(TileChangeRef(trace.tileChanges).v[gl_WorkGroupID.y].noise, noise);
}

// Adds a pixel's relative variance to that of its tile, once the pilot is complete.
void reportPilot(TraceRecord trace, TileWork tile, vec3 mean, vec3 spread) {
    if (tile.firstSample + tile.sampleCount != trace.pilot) return;
    const float variance = dot(spread, vec3(1.0 / 3.0)) / float(trace.pilot - 1u);
    const float level = max(dot(mean, vec3(1.0 / 3.0)), trace.darkest);
    const uint steps = uint(min(variance / (level * level) * VARIANCE_STEPS, MAX_PIXEL_VARIANCE));
    if (steps > 0u) atomicAdd(TileChangeRef(trace.tileChanges).v[gl_WorkGroupID.y].variance, steps);
}

void main() {
    const TraceRecord trace = TraceRecordRef(push.record).v;
    const TileWork tile = TileRef(trace.tiles).v[gl_WorkGroupID.y];
    const uint local = gl_GlobalInvocationID.x;
    if (local >= tile.width * tile.height) return;
    const uint pixel = tile.x + local % tile.width + (tile.y + local / tile.width) * trace.width;

    // The first sample replaces what an earlier picture left in the pixel, and the first after the pilot the pilot.
    FilmPixel sum = FilmPixel(vec4(0.0), vec3(0.0), 0u, vec3(0.0), vec3(0.0));
    vec3 spread = vec3(0.0);
    if (tile.firstSample != 0u && tile.firstSample != trace.pilot) {
        sum = FilmRef(trace.film).v[pixel];
        if (trace.spreads != 0ul) spread = SpreadRef(trace.spreads).v[pixel];
    }
    vec3 color = sum.color.rgb;
    for (uint i = 0u; i < tile.sampleCount; ++i) {
        const PathState path = PathRef(trace.paths).v[tile.firstSlot + local * tile.sampleCount + i];
        const vec3 radiance = pathRadiance(trace, path);
        if (i == 0u && tile.firstSample == 0u) {
            replaceFirstSample(trace, pixel, radiance);
            retire(trace, tile.flags, pixel, radiance);
            if (trace.seen != 0ul)
                SeenRef(trace.seen).v[pixel] = PathSeenRef(trace.pathSeen).v[tile.firstSlot + local * tile.sampleCount];
        }
        const vec3 before = radiance - color / float(max(sum.count, 1u));
        addTo(color, sum.colorError, radiance);
        // B. P. Welford, "Note on a method for calculating corrected sums of squares and products", Technometrics
        // 4(3), 1962: subtracting the mean's square from the mean of squares would leave rounding errors only.
        if (trace.spreads != 0ul && sum.count > 0u) spread += before * (radiance - color / float(sum.count + 1u));
        ++sum.count;
        addTo(sum.albedo, sum.albedoError, path.albedo);
        sum.color.a += path.alpha; // whole numbers
    }
    sum.color.rgb = color;
    FilmRef(trace.film).v[pixel] = sum;
    if (trace.spreads == 0ul) return;
    SpreadRef(trace.spreads).v[pixel] = spread;
    reportPilot(trace, tile, color / float(sum.count), spread);
}
