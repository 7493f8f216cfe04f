// Light path expressions on the device: renderer/lpe builds the tables, shaders/trace/lpe.glsl walks them.
#ifndef HIPR_SHARED_LPE_H
#define HIPR_SHARED_LPE_H
#include "language.h"
HIPR_SHARED_BEGIN

// What happens to a path. Lights come last, by kind and group: LPE_LIGHTS + kind * (groups + 1) + group.
HIPR_CONST uint LPE_CAMERA = 0u;
HIPR_CONST uint LPE_DIFFUSE = 1u;        // reflections by lobe
HIPR_CONST uint LPE_SHEEN = 2u;
HIPR_CONST uint LPE_SPECULAR = 3u;
HIPR_CONST uint LPE_COAT = 4u;
HIPR_CONST uint LPE_DIFFUSE_THROUGH = 5u;
HIPR_CONST uint LPE_SUBSURFACE = 6u;
HIPR_CONST uint LPE_TRANSMISSION = 7u;
HIPR_CONST uint LPE_VOLUME = 8u;
HIPR_CONST uint LPE_LIGHTS = 9u;
HIPR_CONST uint LPE_LIGHT = 0u;          // kinds
HIPR_CONST uint LPE_DOME = 1u;
HIPR_CONST uint LPE_OBJECT = 2u;
HIPR_CONST uint LPE_LIGHT_KINDS = 3u;

// A surface scatters a path by several lobes at once, so a path is in several states, each for a share of what it brings.
HIPR_CONST uint LPE_SHARES = 4u;
struct LpeShare {
    uint state;              // 0: what the path brings from here on is in no expression
    vec3 weight;
};

struct LpePath {
    uint current;            // which of the two lists counts; the other is where the next one is made
    LpeShare shares[2 * LPE_SHARES];
};

// Sums of one expression over the samples of one pixel, with what rounding has kept out: see FilmPixel.
struct LpePixel {
    vec3 sum;
    vec3 error;
};

struct LpeRecord {
    uint64_t next;           // uint[state * symbols + symbol]
    uint64_t accepted;       // uint[state]: a bit for each expression that a path is in which ends there
    uint64_t groups;         // uint[groupCount]: interned names of light groups
    uint64_t paths;          // LpePath[]
    uint64_t sums;           // vec3[path * count + expression]: what a path has brought
    uint64_t shadows;        // vec3[path * count + expression]: the expression's share of the path's shadow ray
    uint64_t film;           // LpePixel[pixel * count + expression]
    uint symbols;
    uint groupCount;
    uint count;              // expressions
    uint start;              // state at the camera
};

HIPR_SHARED_END
#endif
