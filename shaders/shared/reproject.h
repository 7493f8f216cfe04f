// Camera moves: the picture on display is carried to where the new camera sees what it shows. Compiled as GLSL and as
// C++. How and why: docs/hipr.md, "Camera motion".
#ifndef HIPR_SHARED_REPROJECT_H
#define HIPR_SHARED_REPROJECT_H
#include "hipr.h"
HIPR_SHARED_BEGIN

// SeenPoint::look holds the share of the scattered light that depends on the view (bits 0..7), the GGX slope parameter of
// the lobes that do (8..15), and how stale the pixel's light is from earlier moves, relative to it (16..31, at most
// 65534); or one of these.
HIPR_CONST uint SEEN_NOTHING = 0xffffffffu;
HIPR_CONST uint SEEN_SKY = 0xfffffffeu; // SeenPoint::point is a direction
HIPR_CONST float STALE_STEPS = 65534.0f;

// A lobe of this slope parameter or less changes altogether when the view turns by as many radians.
HIPR_CONST float LEAST_TURN = 0.01f;

HIPR_INLINE float viewShare(uint look) { return float(look & 255u) / 255.0f; }
HIPR_INLINE float viewAlpha(uint look) { return float(look >> 8u & 255u) / 255.0f; }
HIPR_INLINE float staleness(uint look) { return look >= SEEN_SKY ? 0.0f : float(look >> 16u) / STALE_STEPS; }

HIPR_INLINE uint packLook(float share, float alpha, float stale) {
    uint s = uint(min(max(share, 0.0f), 1.0f) * 255.0f + 0.5f);
    uint a = uint(min(max(alpha, 0.0f), 1.0f) * 255.0f + 0.5f);
    uint t = uint(min(max(stale, 0.0f), 1.0f) * STALE_STEPS + 0.5f);
    return s | a << 8u | t << 16u;
}

// The look after the view of the point has turned by `angle`, in radians. No more can be stale than depends on the view.
HIPR_INLINE uint turnedLook(uint look, float angle) {
    if (look >= SEEN_SKY) return look;
    float share = viewShare(look);
    float alpha = viewAlpha(look);
    return packLook(share, alpha, min(share, staleness(look) + share * angle / (alpha + LEAST_TURN)));
}

// Where the picture's pixel goes. `depth` sorts what meets in one pixel: distance from the near plane, above all others
// for the sky.
struct CarriedPixel {
    bool inside;
    uint x;
    uint y;
    float depth;
};
HIPR_CONST float SKY_DEPTH = 3.402823466e38f;

HIPR_INLINE CarriedPixel carryPixel(CameraRecord camera, SeenPoint seen, uint x, uint y, uint width, uint height) {
    CarriedPixel carried;
    carried.inside = false;
    carried.x = x;
    carried.y = y;
    carried.depth = SKY_DEPTH;
    if (seen.look == SEEN_NOTHING) return carried;
    if (seen.look != SEEN_SKY) {
        FilmPoint p = projectToFilm(camera, seen.point, width, height);
        carried.inside = p.inside;
        carried.x = p.x;
        carried.y = p.y;
        carried.depth = max(p.depth - camera.nearDepth, 0.0f);
        return carried;
    }
    vec4 clip = camera.worldToClip * vec4(seen.point.x, seen.point.y, seen.point.z, 0.0f);
    if (clip.w == 0.0f) { // all rays of an orthographic camera see the sky in one direction
        carried.inside = true;
        return carried;
    }
    float u = (0.5f * clip.x / clip.w + 0.5f) * float(width);
    float v = (0.5f * clip.y / clip.w + 0.5f) * float(height);
    carried.inside = clip.w > 0.0f && u >= 0.0f && v >= 0.0f && u < float(width) && v < float(height);
    if (!carried.inside) return carried;
    carried.x = uint(u);
    carried.y = uint(v);
    return carried;
}

// The unit direction in which a camera sees a point.
HIPR_INLINE vec3 viewDirection(CameraRecord camera, vec3 point) {
    bool pinhole = largest(camera.directionX) > 0.0f || largest(camera.directionY) > 0.0f;
    return normalize(pinhole ? point - camera.origin : camera.direction);
}

// Depths within this share of each other are of one surface.
HIPR_CONST float SURFACE_TOLERANCE = 0.05f;
HIPR_INLINE bool oneSurface(float a, float b) { return abs(a - b) <= SURFACE_TOLERANCE * min(a, b); }

// What came to the pixels of the new picture: lists with an entry a pixel, one after another, so that a kernel's memory
// traffic is that of the lists it needs. Pixels of either picture are x | y << 16.
HIPR_CONST uint CARRIED_DEPTHS = 0u;  // bits of CarriedPixel::depth of the nearest; NO_INDEX: nothing came
HIPR_CONST uint CARRIED_SOURCES = 1u; // where the nearest came from
HIPR_CONST uint CARRIED_MENDED = 2u;  // which old pixel shows instead, or GUESSED; NO_INDEX: none does
HIPR_CONST uint CARRIED_TORN = 3u;    // pixels of the new picture that are to be mended; CarriedCounts::torn entries
HIPR_CONST uint CARRIED_LISTS = 4u;
HIPR_CONST uint GUESSED = 0xfffffffeu;

// Sums over pixels of the new picture side by side, so many of them; all are of one tile.
HIPR_CONST uint CARRIED_STRIP = 8u;
struct CarriedStrip {
    uint uncovered;          // pixels to which nothing came
    float stale;             // radiance that is stale, as estimated; mean over the channels
    float radiance;          // mean over the channels, of what is shown
};

struct CarriedCounts {
    uint known;              // pixels of the old picture of which it is known what they show
    uint inside;             // of those, the ones that stay in sight
    uint torn;               // entries of CARRIED_TORN
};

// Push constants of all kernels of reprojection: addresses that come from here are the same for all invocations, which
// saves a CPU device reading the cameras once for each.
struct ReprojectionPush {
    uint64_t before;         // CameraRecord of the picture on display
    uint64_t after;          // CameraRecord it is carried to
    uint64_t film;           // FilmPixel[]
    uint64_t oldPicture;     // OldPixel[]: on display where the film is not
    uint64_t carried;        // OldPixel[]: the new picture
    uint64_t tileKeepsOld;   // uint[]: 1 where oldPicture is on display
    uint64_t seen;           // SeenPoint[] of the picture on display
    uint64_t seenAfter;      // SeenPoint[] of the new picture
    uint64_t lists;          // uint[CARRIED_LISTS * width * height]
    uint64_t strips;         // CarriedStrip[]: row by row, rows padded to whole tiles
    uint64_t counts;         // CarriedCounts
    uint64_t depths;         // float[]: camera depths of what the new picture shows, 0 for the sky and what is not known; or 0
    uint width, height;
    uint tileShift;          // the tile size is 1 << tileShift
    uint tileColumns;
};

// Pixels one below the other among which an invocation looks for torn ones.
HIPR_CONST uint CARRIED_ROWS = 16u;
// Workgroups side by side for the list of torn pixels.
HIPR_CONST uint MEND_GROUPS = 1024u;

HIPR_SHARED_END
#endif
