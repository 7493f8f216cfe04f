// Discovery: how paths that start where an edit is seen tell which other tiles it reaches. Compiled as GLSL and as C++.
// The method and its sources: docs/hipr.md.
#ifndef HIPR_SHARED_HIPR_H
#define HIPR_SHARED_HIPR_H
#include "intersect.h"
#include "scene.h"
#include "trace.h"
HIPR_SHARED_BEGIN

// A part of the scene that changed: an object's instance, or all of them.
struct ElementKey {
    uint object;             // ObjectId value
    uint instance;           // index into InstancesDesc::transforms, or EVERY_INSTANCE
};
HIPR_CONST uint EVERY_INSTANCE = 0xffffffffu; // sorts behind the instances

// Where something that changed is or was, in world space.
struct ChangedBox {
    vec3 lo;
    vec3 hi;
};
HIPR_CONST uint MAX_CHANGED_BOXES = 16u;

// Where the surface that a path is at shows in the picture; kept from `discover` to `discover_shadows`.
struct DiscoveryVertex {
    uint tile;               // NO_INDEX: nowhere
    float share;             // of the pixel's light that comes from there: throughput / (1 + k)
};

// What the kernels of discovery share.
struct DiscoveryRecord {
    uint64_t previousHits;   // VisibilityRecord[] of the scene before the edit, or 0
    uint64_t elements;       // ElementKey[elementCount], sorted; EVERY_INSTANCE stands for all others of its object
    uint64_t boxes;          // ChangedBox[boxCount]
    uint64_t tileActive;     // uint[]: 1 where the edit was seen at first hand
    uint64_t tileWeights;    // uint[]: W, in units of 1 / WEIGHT_SCALE
    uint64_t vertices;       // DiscoveryVertex[] by path
    uint elementCount;
    uint boxCount;
    uint tileSize;
    uint tileColumns;
    float eps;               // relative tolerance of the depth test
    float boxExtent;         // largest |coordinate| of the boxes
    float scoutScale;        // pixels that a scout stands for
    float shadowWeight;
    vec4 scatterWeights;     // by SCATTER_*
    vec4 pathWeights;        // by PATH_*
};

// How a path left a vertex. Below SPECULAR_ROUGHNESS a reflection counts as specular.
HIPR_CONST uint SCATTER_DIFFUSE = 0u;
HIPR_CONST uint SCATTER_GLOSSY = 1u;
HIPR_CONST uint SCATTER_SPECULAR = 2u;
HIPR_CONST uint SCATTER_TRANSMISSION = 3u;
HIPR_CONST float SPECULAR_ROUGHNESS = 0.1f;

// What kind of light transport a path stands for.
HIPR_CONST uint PATH_DIRECT = 0u;
HIPR_CONST uint PATH_INDIRECT = 1u;
HIPR_CONST uint PATH_CAUSTIC = 2u;

// PathState::history: the last SCATTER_* in bits 0 and 1, then which vertices scattered diffusely (glossy included).
HIPR_CONST uint HISTORY_LAST = 3u;
HIPR_CONST uint HISTORY_FIRST_DIFFUSE = 4u;
HIPR_CONST uint HISTORY_LATER_DIFFUSE = 8u;

// The history after one more vertex; `depth` vertices came before it.
HIPR_INLINE uint extendHistory(uint history, uint scatter, uint depth) {
    uint extended = (history & ~HISTORY_LAST) | scatter;
    if (scatter == SCATTER_DIFFUSE || scatter == SCATTER_GLOSSY)
        extended |= depth == 0u ? HISTORY_FIRST_DIFFUSE : HISTORY_LATER_DIFFUSE;
    return extended;
}

// The class of a path that scattered at x_0 .. x_(k-1) and has come to x_k, k >= 1. In P. Heckbert's notation (SIGGRAPH
// 1990), read from the eye and with the vertex x_k in place of the light: E(D|S)L and ES+L are direct, EDS+L is a
// caustic, all others are indirect.
HIPR_INLINE uint pathClass(uint history, uint k) {
    if (k <= 1u) return PATH_DIRECT;
    if ((history & HISTORY_LATER_DIFFUSE) != 0u) return PATH_INDIRECT;
    return (history & HISTORY_FIRST_DIFFUSE) != 0u ? PATH_CAUSTIC : PATH_DIRECT;
}

// A throughput as one number, bounded so that no single path decides a tile's rank.
HIPR_INLINE float scalarThroughput(vec3 throughput) {
    float value = 0.2126f * throughput.x + 0.7152f * throughput.y + 0.0722f * throughput.z;
    return min(max(value, 0.0f), 4.0f);
}

// Sums of fixed-point numbers do not depend on their order.
HIPR_CONST float WEIGHT_SCALE = 4096.0f;
HIPR_INLINE uint fixedWeight(float weight) { return uint(weight * WEIGHT_SCALE + 0.5f); }

// A point of the film, and how far from the camera what shows there is (see VisibilityRecord::cameraDepth).
struct FilmPoint {
    bool inside;             // in the picture and between the clip planes
    uint x;
    uint y;
    float depth;
};

HIPR_INLINE FilmPoint projectToFilm(CameraRecord camera, vec3 position, uint width, uint height) {
    FilmPoint point;
    point.inside = false;
    point.x = 0u;
    point.y = 0u;
    point.depth = 0.0f;
    vec4 clip = camera.worldToClip * vec4(position.x, position.y, position.z, 1.0f);
    if (!(clip.w > 0.0f)) return point;
    float ndcX = clip.x / clip.w;
    float ndcY = clip.y / clip.w;
    float u = (0.5f * ndcX + 0.5f) * float(width);
    float v = (0.5f * ndcY + 0.5f) * float(height);
    if (!(u >= 0.0f && v >= 0.0f && u < float(width) && v < float(height))) return point;
    vec3 origin = camera.origin + ndcX * camera.originX + ndcY * camera.originY;
    point.depth = dot(camera.forward, position - origin);
    point.inside = point.depth >= camera.nearDepth && point.depth <= camera.farDepth;
    point.x = uint(u);
    point.y = uint(v);
    return point;
}

// Whether a depth is that of the surface seen through a pixel, whose depth changes by `slope` from pixel to pixel.
HIPR_CONST float DEPTH_SLOPE_SHARE = 1.5f;
HIPR_INLINE bool depthAgrees(float depth, float seen, float slope, float eps) {
    return abs(depth - seen) <= max(eps * seen, DEPTH_SLOPE_SHARE * slope);
}

// Whether the part of a ray from its origin to `reach` meets a box; `extent` as in boxRay.
HIPR_INLINE bool meetsBox(vec3 origin, vec3 direction, float reach, ChangedBox box, float extent) {
    float entry, exit;
    boxInterval(boxRay(origin, direction, extent), box.lo, box.hi, entry, exit);
    return entry <= exit && exit >= 0.0f && entry <= reach;
}

HIPR_SHARED_END
#endif
