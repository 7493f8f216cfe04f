// Wavefront state: one slot a path. See renderer/trace/.
#ifndef HIPR_SHARED_TRACE_H
#define HIPR_SHARED_TRACE_H
#include "language.h"
HIPR_SHARED_BEGIN

// Work items: a rectangle of one tile times a range of samples. Slots are numbered tile-major, then pixel, then sample.
struct TileWork {
    uint x, y;               // first pixel
    uint width, height;      // pixels (clipped to the film)
    uint firstSample;
    uint sampleCount;
    uint firstSlot;
    uint pad;
};

// Pinhole or orthographic, from matrices.
struct CameraRecord {
    mat4 clipToWorld;
    mat4 worldToClip;
    mat4x3 worldToView;
    vec3 origin;             // perspective only
    uint orthographic;
    vec3 forward;            // unit view axis in world space
    uint pad;
};

// The first hit of the ray through the pixel centre; every "first hit" AOV is resolved from it.
struct VisibilityRecord {
    uint instance;           // NO_INDEX: nothing
    uint primitive;
    float u, v;
    float cameraDepth;       // distance along `forward`
};

HIPR_SHARED_END
#endif
