// Gaussian splats: the records of the splat pass, compiled as GLSL and as C++. The method: docs/higs.md.
#ifndef HIPR_SHARED_HIGS_H
#define HIPR_SHARED_HIGS_H
#include "language.h"
#include "trace.h"
HIPR_SHARED_BEGIN

// One pixel of the splat pass. Depth and ids are those of the splat at which the transmittance falls below 1/2, the
// median of what covers the pixel; where it stays above there is none: depth 0, ids -1, splat NO_SPLAT.
struct SplatPixel {
    vec3 color;          // premultiplied by alpha
    float transmittance; // 1 - alpha: what of the light behind comes through
    float depth;         // camera depth of the splat's centre, see CameraRecord
    int primId;
    int instanceId;
    uint splat;          // index in its cloud
};
HIPR_CONST uint NO_SPLAT = 0xffffffffu;

// Beyond this many standard deviations an opacity of 1 leaves less than 1/255.
HIPR_CONST float SPLAT_MAX_EXTENT = 3.33f;
// A splat contributes alpha = 2^-sigma where sigma = u^2 + v^2 - log2(opacity) is below log2(255).
HIPR_CONST float SPLAT_SIGMA_LIMIT = 7.99435344f;
HIPR_CONST float SPLAT_LEAST_ALPHA = 1.0f / 255.0f;
HIPR_CONST float LOG2_E = 1.44269504f;
// Added to the variance along both axes of the film: by 3DGS, and by Mip-Splatting's filter, which makes up for it.
HIPR_CONST float SPLAT_DILATION = 0.3f;
HIPR_CONST float SPLAT_FILTER = 0.1f;
// A splat that is projected tangentially becomes the Gaussian of the picture that has this contour right, in squared
// standard deviations: the best one by numbers. It is an earlier one where this one reaches too far round the camera.
HIPR_CONST float SPLAT_TANGENT_CONTOUR = 2.0f;
HIPR_CONST float SPLAT_TANGENT_LIMIT = 0.5f;
// A tile is finished where less than this comes through all its pixels.
HIPR_CONST float SPLAT_OPAQUE = 1e-4f;

HIPR_CONST uint SPLAT_BLOCK = 256u;        // splats a workgroup projects, all of one placement
HIPR_CONST uint SPLAT_CHUNKS = 256u;       // parts in which lanes bin splats
HIPR_CONST uint SPLAT_BATCH = 1024u;       // pairs that are sorted, and in mode higs8 drawn, as one
HIPR_CONST uint SPLAT_MINI_BATCH = 32u;    // pairs whose hits of one render tile are the bits of one word
HIPR_CONST uint SPLAT_TILE = 8u;           // edge of a render tile in pixels
HIPR_CONST uint SPLAT_DIGITS = 256u;       // of one pass of sorting
HIPR_CONST uint SPLAT_MERGES = 14u;        // a list has up to SPLAT_BATCH << SPLAT_MERGES pairs
HIPR_CONST uint SPLAT_MACRO_WIDTH = 64u;   // pixels of a macro-tile: 8 x 4 render tiles
HIPR_CONST uint SPLAT_MACRO_HEIGHT = 32u;
HIPR_CONST uint SPLAT_LANES_TILES = 32u;   // render tiles that a workgroup draws in lanes: as many as a macro-tile has

// A cloud on the device.
struct SplatArrays {
    uint64_t positions;    // vec3[count], object space
    uint64_t shapes;       // uvec4[count]: quaternion xy, zw (snorm16), scale xy (half), scale z (half) and opacity (unorm16)
    uint64_t coefficients; // half[count][3 * evenCount((degree + 1)^2)], or 0: colour 0.5
    uint count;
    uint degree;
    float scaleUnit;       // scales are in units of it
    uint pad;
};

// An instance as the kernels see it. A point p of object space is seen at pixel (pixelX . p, pixelY . p) / (clipW . p),
// p extended by 1.
struct SplatPlacement {
    SplatArrays arrays;
    vec4 pixelX;
    vec4 pixelY;
    vec4 clipW;
    vec4 depth;              // depth . p: camera depth
    vec3 eye;                // object space: the camera's origin
    vec3 direction;          // object space: of view, where all rays are parallel
    vec3 toWorldX;           // columns of the linear part of object to world
    vec3 toWorldY;
    vec3 toWorldZ;
    uint first;              // of its splats among all
    int primId;
    int instanceId;
    uint flags;              // SPLATS_*
};
HIPR_CONST uint SPLATS_HIDDEN = 1u;
HIPR_CONST uint SPLATS_TANGENTIAL = 2u;

// Where to find the splats of a block.
struct SplatBlock {
    uint placement;
    uint first;              // in its cloud
};

// A splat on the film: what rasterisation wants. Let d be the distance from its mean in pixels; sigma is
// (shape.x d.x + shape.y d.y)^2 + (shape.z d.y)^2 + bias. Splats that are not seen have a bias of SPLAT_SIGMA_LIMIT.
struct ProjectedSplat {
    vec2 mean;
    vec3 shape;              // Cholesky factor of half the inverse covariance, times log2(e)
    float bias;              // -log2(opacity)
    vec3 color;
    float depth;             // camera depth of the centre
};

// The same with shape, bias and colour in half precision.
struct ProjectedSplatHalf {
    vec2 mean;
    uint shapeXY;
    uint shapeZBias;
    uint colorRG;
    uint colorB;
    float depth;
    uint pad;                // kernels read and write pairs of words
};

// What binning wants of a splat on the film.
struct SplatReach {
    uint tiles;              // which tiles it meets: in the lower bits the number of one, above for each of
                             // SPLAT_NEAR_ROWS x SPLAT_NEAR_COLUMNS from there on a bit; 0: none, SPLAT_FAR: not told here
    float key;               // by which splats are sorted, unless it depends on the ray; not negative
};
HIPR_CONST uint SPLAT_NEAR_ROWS = 3u;
HIPR_CONST uint SPLAT_NEAR_COLUMNS = 4u;
HIPR_CONST uint SPLAT_NEAR_SHIFT = 20u;    // bits for the number
HIPR_CONST uint SPLAT_FAR = 0xffffffffu;

// The density along a ray o + t d, d of unit length, is largest at t = d . (pull - m o') / (d . m d), o' being the
// ray's origin relative to the camera's; world space.
struct SplatRay {
    vec3 diagonal;           // of m, the inverse covariance
    vec3 other;              // m's xy, xz, yz
    vec3 pull;               // m times the centre, relative to the camera's origin
};

// (splat, tile) of a list: sorted by key, then by splat, which is the order of these as 64-bit numbers.
struct SplatPair {
    uint splat;
    uint key;                // bits of a float that is not negative
};

// The same in the flat modes, where all lists are sorted as one: by tile, key and splat.
struct SplatTilePair {
    uint key;
    uint splat;
    uint tile;
};

// A tile of the binning grid and its list. In modes with macro-tiles lists start at multiples of SPLAT_MINI_BATCH.
struct SplatTile {
    uint first;              // pair
    uint count;
    uint firstBatch;
    uint side;               // which of the two arrays of pairs holds the sorted list
};

// What a batch leaves of a pixel, in mode higs8.
struct SplatPartial {
    vec3 color;
    float transmittance;
};

// Written by kernels, read by indirect dispatches and, after a frame, by the host.
struct SplatState {
    uvec3 sortGroups;        // one lane or workgroup a batch
    uvec3 maskGroups;
    uvec3 partialGroups;     // workgroups that draw a batch's render tiles
    uvec3 mergeGroups[SPLAT_MERGES];
    uint pairs;              // of all lists, without gaps
    uint pairsEnd;           // with gaps; may exceed the capacity: then nothing is drawn
    uint batches;
    uint largestList;
    uint visible;            // while profiling
    uint sortMoves;          // while profiling: pairs that sorting has moved
    uint overflow;
};

// Everything the kernels share; rewritten for each frame.
struct SplatFrame {
    uint64_t placements;     // SplatPlacement[placementCount], ordered by `first`
    uint64_t blocks;         // SplatBlock[]
    uint64_t splats;         // ProjectedSplat[splatCount], or ProjectedSplatHalf[]
    uint64_t reaches;        // SplatReach[splatCount]
    uint64_t rays;           // SplatRay[splatCount], or 0: lists are sorted by SplatReach::key
    uint64_t histogram;      // uint[SPLAT_CHUNKS][tiles], or uint[tiles] where workgroups bin
    uint64_t tiles;          // SplatTile[tileColumns * tileRows]
    uint64_t tileMask;       // uint[tiles]: 0 where nothing is to be drawn
    uint64_t pairs[2];       // SplatPair[pairCapacity]
    uint64_t tilePairs[2];   // SplatTilePair[pairCapacity], in flat modes
    uint64_t masks;          // uint[pairCapacity]: of each mini-batch one word a render tile
    uint64_t partials;       // SplatPartial[batchCapacity][32 render tiles][64 pixels], in mode higs8
    uint64_t pixels;         // SplatPixel[width * height]
    uint64_t emptied;        // uint[render tiles]: 1 where the pixels hold the value of nothing
    uint64_t depthLimit;     // float[width * height], or 0
    uint64_t state;          // SplatState
    uint64_t camera;         // CameraRecord
    uint64_t blends;         // uvec2[tiles]: tried, done; while profiling
    uint placementCount;
    uint splatCount;         // rounded up to whole blocks for every placement
    uint width;
    uint height;
    uvec2 cropLo;            // pixels to draw
    uvec2 cropHi;            // past the last
    uint tileWidth;          // of the binning grid, in pixels
    uint tileHeight;
    uint tileColumns;
    uint tileRows;
    uint pairCapacity;
    uint batchCapacity;
    float nearDepth;
    float farDepth;
    uint sorting;            // hipr::SplatSorting
    uint flags;              // FRAME_*
};
HIPR_CONST uint SORT_Z_DEPTH = 0u;         // values of hipr::SplatSorting
HIPR_CONST uint SORT_CAMERA_DISTANCE = 1u;
HIPR_CONST uint SORT_RAY_HIT_DISTANCE = 2u;
HIPR_CONST uint FRAME_ANTIALIASED = 1u;
HIPR_CONST uint FRAME_PROFILING = 2u;
HIPR_CONST uint FRAME_PARALLEL = 4u;       // an orthographic camera
HIPR_CONST uint FRAME_SQUARES = 8u;        // tiles are those that meet a square of 3 standard deviations
HIPR_CONST uint FRAME_SRGB = 16u;          // coefficients give sRGB-encoded colours

// Push constants of every kernel of the pass.
struct SplatPush {
    uint64_t frame;          // SplatFrame
    uint first;              // project: block; merge: level; raster: row of
                             // render tiles; radix: shift
    uint count;              // project, touch: block after the last; radix: which side is read
};

HIPR_SHARED_END
#endif
