// Wavefront state: one slot a path. See renderer/trace/path_tracer.h.
#ifndef HIPR_SHARED_TRACE_H
#define HIPR_SHARED_TRACE_H
#include "language.h"
HIPR_SHARED_BEGIN

// Work items: a lattice of pixels times a range of samples. Slots are numbered item-major, then pixel, then sample.
struct TileWork {
    uint x, y;               // first pixel
    uint width, height;      // pixels of the lattice, all within the film
    uint firstSample;
    uint sampleCount;
    uint firstSlot;
    uint stride;             // distance of the lattice's pixels; 1: a rectangle of the film
    uint flags;              // TILE_*
};
HIPR_CONST uint TILE_SAVES_OLD = 1u; // the mean on display goes to TraceRecord::oldPicture before sample 0 replaces it
HIPR_CONST uint TILE_KEEPS_OLD = 2u; // the mean on display is in TraceRecord::oldPicture already

HIPR_CONST uint MAX_CLIP_PLANES = 8u;

// Perspective or orthographic, from matrices. The ray through NDC (x, y) has
//   direction = normalize(direction + x * directionX + y * directionY),
//   origin    = origin + x * originX + y * originY   (the axes are 0 for a pinhole),
// which is exact for every projective matrix and, unlike unprojecting two points, keeps its precision far from the
// world's origin. Seen is what has a depth of nearDepth to farDepth, depth being dot(forward, point - origin).
struct CameraRecord {
    mat4 worldToClip;
    mat4x3 worldToView;
    vec3 origin;
    float nearDepth;
    vec3 originX;
    float farDepth;
    vec3 originY;
    vec3 direction;
    vec3 directionX;
    vec3 directionY;
    vec3 forward;            // gradient of the view-space depth: the view axis, of unit length unless the view scales
    vec3 lensX, lensY;       // radii of the aperture; 0 for a pinhole. Rays of one point of the film meet at focusDepth
    float focusDepth;
    uint lensBlades;         // 0: a disk
    uint clipPlaneCount;
    vec4 clipPlanes[MAX_CLIP_PLANES]; // seen is dot(xyz, point - origin) + w >= 0
};

// The first hit of the ray through the pixel centre; every "first hit" AOV is resolved from it.
struct VisibilityRecord {
    uint instance;           // NO_INDEX: nothing
    uint primitive;
    float u, v;
    float cameraDepth;       // depth, see CameraRecord
    uint object;             // ObjectId value; 0: nothing. With the next field, what is seen whatever the order of instances
    uint objectInstance;     // index into InstancesDesc::transforms
};

// What a pixel on display shows: the point of a surface under the pixel's centre, in world space, and how it looks from
// elsewhere (`look`, see reproject.h).
struct SeenPoint {
    vec3 point;
    uint look;
};

// One path between two kernels.
struct PathState {
    vec3 throughput;
    float bsdfPdf;           // of the ray in flight; below 0: camera ray or delta lobe, lights count in full
    vec3 radiance;           // seen directly, or lighting the first surface directly
    uint event;              // surfaces met, passed ones included: numbers the random vectors
    vec3 indirect;           // everything after more bounces
    uint depth;              // surfaces that scattered the path
    vec3 albedo;             // of the first surface that scattered it
    float alpha;
    uint pixel;              // x + y * 65536
    uint sampleIndex;        // bit 31: SECOND_SAMPLE_SET
    uint history;            // how it scattered so far: HISTORY_* in hipr.h
    uint medium;             // MEDIUM_*
    uint mediumColor;        // colour of a subsurface medium where the path entered it: packMediumColor() in medium.glsl
    uint mediumRadius;       // its radius there: packMediumRadius()
    uint categories;         // InstanceRecord::categories of the surface that scattered it last
    uint lightNormal;        // of that surface, where light reaches one side alone: see shaders/light/tree.glsl
    uvec2 interiors;         // what the path is inside of: see shaders/material/nesting.glsl
    vec2 cone;               // width at the origin of the ray in flight, and how much it grows per length: see trace/cone.glsl
};

// What a shadow ray carries.
struct ShadowWork {
    vec3 contribution;       // as if no other way led to the light
    uint slot;               // path; SHADOW_INDIRECT added when it belongs to PathState::indirect
    uint64_t shadow;         // LightRecord::shadow
    float weight;            // against finding the light by the BSDF, which takes a free way
    uint event;              // of the path when it was sampled: tells its random numbers from those of others
};

// The same on its way through surfaces.
struct TransmitWork {
    ShadowWork work;
    float direct;            // share that no surface has stopped
    float aside;             // share that was stopped, by surfaces that cast no shadow of this light
    vec3 through;            // of a mesh that is a light: share that its shadows let through so far
};
HIPR_CONST uint SHADOW_INDIRECT = 0x80000000u;

// Sums over the samples of one pixel, and what rounding has kept out of them so far (compensated summation).
struct FilmPixel {
    vec4 color;
    vec3 albedo;
    uint count;
    vec3 colorError;
    vec3 albedoError;
};

// What one path of a scout tells: the radiance of its pixel's sample 0 in the current scene, against the same sample in
// the picture on display.
struct ScoutResult {
    uint pixel;              // x + y * 65536
    float change;            // mean over the channels of |new - old|
    float radiance;          // mean over the channels of new
};

// The picture on display before an edit, where it stays there for a while. Lies in memory as a FilmPixel begins.
struct OldPixel {
    vec4 color;
    vec3 albedo;
    uint count;              // 1
};

// How the first new samples of a work item differ from the picture on display: sums over its pixels, in units of
// 1 / TraceRecord::changeScale, whole numbers so that no order of adding shows.
struct TileChange {
    uint change;             // of the mean over the channels of |new - old|, old being the same sample
    uint noise;              // of the same with the mean on display for old, where a flag of the work item tells where it is
    uint variance;           // where the pilot ends: relative variance of one sample, in units of 1 / VARIANCE_STEPS
};
HIPR_CONST float MAX_PIXEL_CHANGE = 65535.0f; // in the same units; 2^15 pixels fit
HIPR_CONST float VARIANCE_STEPS = 4096.0f;
HIPR_CONST float MAX_PIXEL_VARIANCE = 1048576.0f; // in those steps; 2^11 pixels fit

// Adaptive sampling: numbers of the pilot and of the picture come from sets of their own. Bit 31 of a sample's index
// tells them apart, and changes the seed by this.
HIPR_CONST uint SECOND_SAMPLE_SET = 0x80000000u;
HIPR_CONST uint SECOND_SET_SEED = 0x5bd1e995u;

// One AOV that is resolved from the first hit; one value a pixel.
struct AovTarget {
    uint64_t values;
    uint kind;               // hipr::AovKind
    uint primvar;            // interned name
};

HIPR_CONST uint AOV_DEPTH = 2u; // values of hipr::AovKind
HIPR_CONST uint AOV_CAMERA_DEPTH = 3u;
HIPR_CONST uint AOV_NORMAL = 4u;
HIPR_CONST uint AOV_NEYE = 5u;
HIPR_CONST uint AOV_PRIM_ID = 6u;
HIPR_CONST uint AOV_INSTANCE_ID = 7u;
HIPR_CONST uint AOV_ELEMENT_ID = 8u;
HIPR_CONST uint AOV_PRIMVAR = 9u;
HIPR_CONST uint AOV_PEYE = 14u;
HIPR_CONST uint AOV_PATCH_COORD = 15u;
HIPR_CONST uint AOV_MOTION = 21u;

// Indices of the queue headers. Ray and transmit queues are read and written in turns; shadow headers alternate so
// that one can be cleared while the other is in use.
HIPR_CONST uint QUEUE_RAYS = 0u;     // 2
HIPR_CONST uint QUEUE_SHADOW = 2u;   // 2
HIPR_CONST uint QUEUE_TRANSMIT = 4u; // 2
HIPR_CONST uint QUEUE_COUNT = 6u;

// Surfaces one path may pass straight through, and those one shadow ray may; longer paths end, longer rays are blocked.
HIPR_CONST uint PATH_PASS_LIMIT = 256u;
// Events one path may have without being scattered by a surface while it is in a scattering medium.
HIPR_CONST uint MEDIUM_STEP_LIMIT = 1024u;
HIPR_CONST uint SHADOW_PASS_LIMIT = 256u;

struct TraceCounters {
    uint64_t rays[3];        // traced from ray, shadow and transmit queues: [queue / 2]
    uint nonFinite;          // dropped contributions
    uint pad;
};

// Cryptomatte: how many samples of a pixel saw what has this id. The entries of a pixel that are in use come first.
HIPR_CONST uint CRYPTOMATTE_RANKS = 6u;
HIPR_CONST uint CRYPTOMATTE_KINDS = 3u; // object, material, asset
struct CryptoEntry {
    float id;
    uint count;              // 0: not in use
};

// Everything the wavefront kernels share; rewritten when film, settings, camera or scene change.
struct TraceRecord {
    uint64_t scene;          // SceneRecord
    uint64_t camera;         // CameraRecord
    uint64_t cameraKeys;     // mat4x3[cameraKeyCount]: of points relative to CameraRecord::origin, see motion.h
    uint64_t tiles;          // TileWork[]
    uint64_t headers;        // QueueHeader[QUEUE_COUNT]
    uint64_t counters;       // TraceCounters
    uint64_t paths;          // PathState[]
    uint64_t rays[2];        // Ray[]
    uint64_t raySlots[2];    // uint[]: the path of each ray
    uint64_t hits;           // Hit[]
    uint64_t shadowRays;     // Ray[]
    uint64_t shadowWork;     // ShadowWork[]
    uint64_t shadowEnds;     // Hit[]: the emissive surface at which a shadow ray ends and by whose emission ShadowWork::contribution
                             // is to be multiplied, instance NO_INDEX: none. Only in scenes with SCENE_HAS_MESH_LIGHTS
    uint64_t shadowResults;  // uint[]
    uint64_t transmitRays[2];
    uint64_t transmitWork[2];// TransmitWork[]
    uint64_t transmitHits;
    uint64_t film;           // FilmPixel[]
    uint64_t visibility;     // VisibilityRecord[]
    uint64_t opaqueDepths;   // float[]: VisibilityRecord::cameraDepth, 0 where nothing is seen; or 0
    uint64_t oldPicture;     // OldPixel[]
    uint64_t firstSamples;   // vec3[]: radiance of each pixel's sample 0 in the picture on display
    uint64_t spreads;        // vec3[]: sum of the squares of what a pixel's samples differ from their mean by; or 0
    uint64_t seen;           // SeenPoint[]: what each pixel on display shows, as its sample 0 saw it; or 0
    uint64_t pathSeen;       // SeenPoint[] by path: what sample 0 sees
    uint64_t pathSlots;      // uint[] by path: index of the SlotNames of the first surface, NO_INDEX: none; or 0
    uint64_t cryptomattes[CRYPTOMATTE_KINDS]; // CryptoEntry[][CRYPTOMATTE_RANKS] by pixel, or 0
    uint64_t lpe;            // LpeRecord (lpe.h), or 0
    uint64_t scoutResults;   // ScoutResult[]
    uint64_t tileChanges;    // TileChange[]: one a work item
    uint64_t aovs;           // AovTarget[aovCount]
    uint64_t discovery;      // DiscoveryRecord (hipr.h), or 0
    uint aovCount;
    uint width, height;      // film
    uint maxDepth;
    uint rouletteDepth;
    uint pixelFilter;        // FILTER_*
    float filterWidth;
    float fireflyClamp;
    uint seed;
    float changeScale;       // 0: nobody asks for tileChanges
    uint pilot;              // so many first samples of each pixel only tell how many more it needs; 0: none do
    float darkest;           // the pilot takes errors relative to the radiance, or to this where that is less
    uint cameraKeyCount;     // 0: the camera stands still
    uint moving;             // 1: paths have times
    float frameTime;         // of the shutter, at which first hits are found
    uint filtersTextures;    // 0: textures are read at their finest
};

// Push constants of every wavefront kernel.
struct TraceKernelPush {
    uint64_t record;         // TraceRecord
    uint turn;               // which of two queues is read
    uint first;              // visibility, active: first pixel; prepare: headers to close (bits 0..7), to clear (bits
                             // 8..15); discover: 1 for scouts
    uint count;              // raygen, visibility, scout, active: rays, paths or pixels
    uint pad;
};

HIPR_SHARED_END
#endif
