// Low-discrepancy numbers as a pure function of (pixel, sample, dimension set, seed).
//
// Four-dimensional Sobol points with hash-based Owen scrambling, padded: every dimension set is its own 4D sequence
// whose sample order is shuffled by a nested uniform scramble of the index.
// B. Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020, sections 3 and 5. Direction numbers: S. Joe and
// F. Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM J. Sci. Comput. 30, 2008.
#ifndef HIPR_SAMPLING_SOBOL_GLSL
#define HIPR_SAMPLING_SOBOL_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "shared/trace.h"

// A bijection of 32-bit integers with low bias (exponents and multipliers by C. Wellons, "Prospecting for hash
// functions", 2018, `lowbias32`).
uint hashUint(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

uint hashCombine(uint seed, uint value) {
    return hashUint(seed ^ (value + 0x9e3779b9u + (seed << 6) + (seed >> 2)));
}

// Owen-scrambles bit-reversed values: a bit is changed by bits below it only. Constants: N. Vegdahl, "Building a Better
// LK Hash", 2021, which correct the bias of the hash in Laine and Karras 2011.
uvec4 permuteReversed(uvec4 x, uvec4 seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

uvec4 owenScramble(uvec4 x, uvec4 seed) {
    return bitfieldReverse(permuteReversed(bitfieldReverse(x), seed));
}

// The first four Sobol dimensions of `index`, as 32-bit fixed point. The direction numbers come from their recurrence
// while the loop walks over the index, so no table is indexed.
uvec4 sobolPoint(uint index) {
    uint x = 0u, y = 0u, z = 0u, w = 0u;
    uint vx = 0x80000000u;
    uint vy = 0x80000000u;
    uint vz0 = 0x80000000u, vz1 = 0xc0000000u;                    // m = 1, 3
    uint vw0 = 0x80000000u, vw1 = 0xc0000000u, vw2 = 0x20000000u; // m = 1, 3, 1
    [[dont_unroll]] for (int bit = 0; bit < 32; ++bit) {
        uint mask = 0u - (index & 1u);
        x ^= mask & vx;
        y ^= mask & vy;
        z ^= mask & vz0;
        w ^= mask & vw0;
        vx >>= 1;
        vy ^= vy >> 1;                               // polynomial x + 1
        uint nextZ = vz1 ^ vz0 ^ (vz0 >> 2);         // x^2 + x + 1
        uint nextW = vw1 ^ vw0 ^ (vw0 >> 3);         // x^3 + x + 1
        vz0 = vz1, vz1 = nextZ;
        vw0 = vw1, vw1 = vw2, vw2 = nextW;
        index >>= 1;
    }
    return uvec4(x, y, z, w);
}

// Uniform numbers in [0, 1). `dimensionSet` tells the uses of one path apart (a new set for every decision of every
// bounce); within a set the four numbers are stratified jointly over samples 0..2^k - 1.
// Bit 31 of the index stands for another seed.
vec4 sobol4(uvec2 pixel, uint sampleIndex, uint dimensionSet, uint seed) {
    seed ^= (sampleIndex >> 31) * SECOND_SET_SEED;
    sampleIndex &= ~SECOND_SAMPLE_SET;
    uint h = hashCombine(hashCombine(hashCombine(hashUint(seed), pixel.x), pixel.y), dimensionSet);
    uint index = bitfieldReverse(permuteReversed(uvec4(bitfieldReverse(sampleIndex)), uvec4(h)).x);
    uvec4 seeds = uvec4(hashCombine(h, 1u), hashCombine(h, 2u), hashCombine(h, 3u), hashCombine(h, 4u));
    return vec4(owenScramble(sobolPoint(index), seeds) >> 8) * (1.0 / 16777216.0);
}
#endif
