// Bins all splats. LANES: each invocation bins one of SPLAT_CHUNKS runs of splats by itself; else there is one invocation
// a splat.
#ifndef HIPR_HIGS_BIN_ALL_GLSL
#define HIPR_HIGS_BIN_ALL_GLSL
#include "higs/bin.glsl"

#ifdef LANES
layout(local_size_x = 8) in;
#else
layout(local_size_x = 256) in;
#endif

void visitAll(SplatFrame frame) {
    const uint i = invocationIndex(gl_WorkGroupSize.x);
#ifdef LANES
    if (i >= SPLAT_CHUNKS) return;
    const uint each = (frame.splatCount + SPLAT_CHUNKS - 1u) / SPLAT_CHUNKS;
    const uint end = min((i + 1u) * each, frame.splatCount);
    for (uint splat = i * each; splat < end; ++splat)
        visitTiles(frame, i, splat);
#else
    if (i < frame.splatCount) visitTiles(frame, 0u, i);
#endif
}
#endif
