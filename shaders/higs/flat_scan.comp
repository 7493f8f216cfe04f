// Flat modes: sums over the histogram, leaving the sum of what comes before. One workgroup; each invocation sums one row
// of SPLAT_CHUNKS counters.
// ALL_PAIRS: the one row of the chunks' pairs, whose sum sizes what follows.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "higs/frame.glsl"
#include "higs/scan.glsl"

void main() {
    const SplatFrame frame = FrameRef(push.frame).v;
    WordRef histogram = WordRef(frame.histogram);
    const uint own = gl_LocalInvocationIndex;
#ifdef ALL_PAIRS
    const uint count = histogram.v[own];
    histogram.v[own] = scan(uvec2(count, 0u)).x;
    if (own != 0u) return;
    const uint pairs = sums[THREADS - 1u].x;
    StateRef state = StateRef(frame.state);
    state.v.pairs = pairs;
    state.v.pairsEnd = pairs;
    state.v.overflow = pairs <= frame.pairCapacity ? 0u : 1u;
#else
    uint sum = 0u;
    for (uint chunk = 0u; chunk < SPLAT_CHUNKS; ++chunk)
        sum += histogram.v[own * SPLAT_CHUNKS + chunk];
    uint before = scan(uvec2(sum, 0u)).x;
    for (uint chunk = 0u; chunk < SPLAT_CHUNKS; ++chunk) {
        const uint count = histogram.v[own * SPLAT_CHUNKS + chunk];
        histogram.v[own * SPLAT_CHUNKS + chunk] = before;
        before += count;
    }
#endif
}
