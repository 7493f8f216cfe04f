// In lanes, flat modes: blends all of a list, as 3DGS does, one splat after the other and with an exponential a pixel.
#ifndef HIPR_HIGS_BLEND_ALL_GLSL
#define HIPR_HIGS_BLEND_ALL_GLSL

// 2^-sigma for sigma in [0, 8): a polynomial for 2^(-sigma / 8), fitted to a relative error of 3e-6, squared three times.
float alphaOf(float sigma) {
    float p = fma(sigma, fma(sigma, fma(sigma, fma(sigma, 1.66794227e-6, -1.03952289e-4), 3.74151158e-3), -8.66329461e-2), 1.0);
    p *= p;
    p *= p;
    return p * p;
}

// `d`: from the splat's mean to the middle of the column's first pixel. Along the column sigma is a quadratic polynomial.
void blendColumn(inout Column column, vec2 d, ProjectedSplat s, uint splat) {
    const float u = fma(s.shape.x, d.x, s.shape.y * d.y), v = s.shape.z * d.y;
    const float start = fma(u, u, fma(v, v, s.bias)), slope = 2.0 * fma(s.shape.y, u, s.shape.z * v);
    const float curve = fma(s.shape.y, s.shape.y, s.shape.z * s.shape.z);
    [[unroll]] for (uint y = 0u; y < HEIGHT; ++y) {
        const float sigma = fma(float(y), fma(float(y), curve, slope), start);
        blendPixel(column, y, sigma < SPLAT_SIGMA_LIMIT, alphaOf(sigma), s.color, s.depth, splat);
    }
}

ProjectedSplat shuffled(ProjectedSplat s, uint from) {
    return ProjectedSplat(subgroupShuffle(s.mean, from), subgroupShuffle(s.shape, from), subgroupShuffle(s.bias, from),
                          subgroupShuffle(s.color, from), subgroupShuffle(s.depth, from));
}

// Blends all of `count` pairs from `first` on.
void blendAll(SplatFrame frame, uint64_t pairs, uint first, uint count, vec2 center, inout Column column) {
    for (uint base = 0u; base < count; base += LANES_PER_TILE) {
        const uint own = base + laneInTile();
        ProjectedSplat s = NOTHING;
        uint splat = 0u;
        if (own < count) {
            splat = pairSplat(pairs, first + own);
            s = loadSplat(frame, splat);
        }
        for (uint i = 0u; i < min(count - base, LANES_PER_TILE); ++i) {
            const ProjectedSplat other = shuffled(s, firstLane() + i);
            blendColumn(column, center - other.mean, other, subgroupShuffle(splat, firstLane() + i));
        }
        if (largestOfTile(largestTransmittance(column)) < SPLAT_OPAQUE) break;
    }
}
#endif
