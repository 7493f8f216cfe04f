// Noise on integer lattices, as MaterialX defines it: its nodes noise2d and noise3d, fractal2d and 3d, cellnoise and
// worleynoise are those of Open Shading Language. K. Perlin, "Improving Noise", SIGGRAPH 2002, with gradients chosen by
// B. Jenkins' hash "lookup3" (final() and mix()); S. Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996.
#ifndef HIPR_SHARED_NOISE_H
#define HIPR_SHARED_NOISE_H
#include "language.h"
#ifdef __cplusplus
#include <cmath>
#define HIPR_LOOP
#else
#define HIPR_LOOP [[dont_unroll]]
#endif
HIPR_SHARED_BEGIN
#ifdef __cplusplus
using glm::dot;
using glm::floor;
using glm::mix;
using glm::sqrt;
using glm::uvec3;
using glm::ivec3;
#endif

HIPR_INLINE uint turnLeft(uint x, uint bits) { return (x << bits) | (x >> (32u - bits)); }

// lookup3 of the first `count` (1..4) numbers of `key`; the others are 0.
HIPR_INLINE uint latticeHash(uvec4 key, uint count) {
    uint start = 0xdeadbeefu + 4u * count + 13u;
    uint a = start + key.x, b = start + key.y, c = start + key.z;
    if (count > 3u) {
        a -= c; a ^= turnLeft(c, 4u); c += b;
        b -= a; b ^= turnLeft(a, 6u); a += c;
        c -= b; c ^= turnLeft(b, 8u); b += a;
        a -= c; a ^= turnLeft(c, 16u); c += b;
        b -= a; b ^= turnLeft(a, 19u); a += c;
        c -= b; c ^= turnLeft(b, 4u); b += a;
        a += key.w;
    }
    c ^= b; c -= turnLeft(b, 14u);
    a ^= c; a -= turnLeft(c, 11u);
    b ^= a; b -= turnLeft(a, 25u);
    c ^= b; c -= turnLeft(b, 16u);
    a ^= c; a -= turnLeft(c, 4u);
    b ^= a; b -= turnLeft(a, 14u);
    c ^= b; c -= turnLeft(b, 24u);
    return c;
}

// The lattice cell of a point of 2 or 3 dimensions.
HIPR_INLINE uvec3 latticeCell(vec3 p, uint dimensions) {
    ivec3 cell = ivec3(floor(p));
    return uvec3(uint(cell.x), uint(cell.y), dimensions == 3u ? uint(cell.z) : 0u);
}

HIPR_INLINE float hashToUnit(uint hash) { return float(hash) / 4294967295.0f; }

// One number a cell, 0..1.
HIPR_INLINE float cellNoise(vec3 p, uint dimensions) {
    return hashToUnit(latticeHash(uvec4(latticeCell(p, dimensions), 0u), dimensions));
}

// Three numbers a cell, 0..1.
HIPR_INLINE vec3 cellNoise3(uvec3 cell, uint dimensions) {
    vec3 result = vec3(0.0f);
    HIPR_LOOP for (uint i = 0u; i < 3u; ++i) {
        uvec4 key = dimensions == 3u ? uvec4(cell, i) : uvec4(cell.x, cell.y, i, 0u);
        result = vec3(result.y, result.z, hashToUnit(latticeHash(key, dimensions + 1u))); // rotates into place
    }
    return result;
}

// The part of lattice noise that one corner's gradient makes at the distance `d` from it.
HIPR_INLINE float latticeGradient(uint hash, vec3 d, uint dimensions) {
    uint h = hash & (dimensions == 3u ? 15u : 7u);
    float u, v;
    if (dimensions == 3u) {
        u = h < 8u ? d.x : d.y;
        v = h < 4u ? d.y : (h == 12u || h == 14u ? d.x : d.z);
    } else {
        u = h < 4u ? d.x : d.y;
        v = 2.0f * (h < 4u ? d.y : d.x);
    }
    return ((h & 1u) != 0u ? -u : u) + ((h & 2u) != 0u ? -v : v);
}

// Gradient noise, about -1..1; three independent values, of which MaterialX's scalar noise is the first.
// p.z is 0 in two dimensions.
HIPR_INLINE vec3 gradientNoise(vec3 p, uint dimensions) {
    vec3 low = floor(p), f = p - low;
    vec3 fade = f * f * f * (f * (f * 6.0f - 15.0f) + 10.0f);
    uvec3 cell = latticeCell(p, dimensions);
    vec3 sum = vec3(0.0f);
    uint corners = dimensions == 3u ? 8u : 4u;
    HIPR_LOOP for (uint k = 0u; k < corners; ++k) {
        uvec3 corner = uvec3(k & 1u, (k >> 1u) & 1u, k >> 2u);
        vec3 at = vec3(corner), weights = mix(1.0f - fade, fade, at);
        uint hash = latticeHash(uvec4(cell + corner, 0u), dimensions);
        vec3 d = f - at;
        vec3 value = vec3(latticeGradient(hash & 255u, d, dimensions), latticeGradient((hash >> 8u) & 255u, d, dimensions),
                          latticeGradient((hash >> 16u) & 255u, d, dimensions));
        sum += weights.x * weights.y * weights.z * value;
    }
    return sum * (dimensions == 3u ? 0.9820f : 0.6616f);
}

HIPR_CONST float NOISE_MOST_OCTAVES = 32.0f;

// Octaves of gradient noise, each `lacunarity` times as fine and `diminish` times as strong as the one before.
HIPR_INLINE vec3 fractalNoise(vec3 p, float octaves, float lacunarity, float diminish, uint dimensions) {
    vec3 sum = vec3(0.0f);
    float amplitude = 1.0f, count = octaves < NOISE_MOST_OCTAVES ? octaves : NOISE_MOST_OCTAVES;
    HIPR_LOOP for (float i = 0.0f; i < count; i += 1.0f) {
        sum += amplitude * gradientNoise(p, dimensions);
        amplitude *= diminish;
        p *= lacunarity;
    }
    return sum;
}

// Distances to the three nearest of one point a cell, which lies `jitter` times as far from the middle of the cell as
// chance has it; with `nearest` the nearest of these points instead.
HIPR_INLINE vec3 worleyNoise(vec3 p, float jitter, uint dimensions, bool nearest) {
    uvec3 cell = latticeCell(p, dimensions);
    vec3 within = p - floor(p), least = vec3(1e6f), towards = vec3(0.0f);
    uint neighbours = dimensions == 3u ? 27u : 9u;
    HIPR_LOOP for (uint k = 0u; k < neighbours; ++k) {
        ivec3 step_ = ivec3(int(k % 3u) - 1, int((k / 3u) % 3u) - 1, dimensions == 3u ? int(k / 9u) - 1 : 0);
        vec3 d = (cellNoise3(cell + uvec3(step_), dimensions) - 0.5f) * jitter + 0.5f + vec3(step_) - within;
        if (dimensions == 2u) d.z = 0.0f;
        float squared = dot(d, d);
        if (squared < least.x) {
            least = vec3(squared, least.x, least.y);
            towards = d;
        } else if (squared < least.y) {
            least = vec3(least.x, squared, least.y);
        } else if (squared < least.z) {
            least.z = squared;
        }
    }
    return nearest ? p + towards : sqrt(least);
}

HIPR_SHARED_END
#endif
