// Volumes as kernels see them. The model: renderer/api/volume.h; the method: docs/volumes.md.
#ifndef HIPR_SHARED_VOLUME_H
#define HIPR_SHARED_VOLUME_H
#include "language.h"
HIPR_SHARED_BEGIN

HIPR_CONST uint BRICK_CELLS = 8u;   // along an axis
HIPR_CONST uint BRICK_POINTS = 9u;
HIPR_CONST uint BRICK_VALUES = 729u;

struct BrickEntry {
    uint brick;              // place of its values; NO_INDEX: all are 0
    float largest;           // of them
};

// A field of one volume where it is placed. Its space is that of cells: brick (x, y, z) fills [8 x, 8 x + 8] and so on.
struct FieldRecord {
    mat4x3 placedToCells;    // from world space; of volumes that move from object space
    uint64_t entries;        // BrickEntry[bricks.x * bricks.y * bricks.z], x fastest; 0: no such field
    uint64_t values;         // float[][BRICK_VALUES][channels]
    uvec3 bricks;
    uint channels;           // 1 or 3
};

HIPR_CONST uint VOLUME_EMISSION_SCALED = 1u; // by the values of the field that says where it glows

// One placement of one volume.
struct VolumeRecord {
    vec3 boxMin;             // in world space: nothing of it lies outside while the shutter is open
    vec3 boxMax;
    FieldRecord density;
    FieldRecord glow;        // where it emits: emission, density or temperature
    FieldRecord temperature;
    FieldRecord color;
    vec3 extinction;         // at density 1, per world unit
    float densest;           // largest channel of it
    vec3 scattering;
    float anisotropy;
    vec3 emission;
    float temperatureScale;
    uint flags;              // VOLUME_*
    uint seed;
    uint categories;         // for light linking
    int primId;
    int instanceId;
    uint object;             // as in InstanceRecord
    uint objectInstance;
    uint keyCount;           // 0: stands still; else see motion.h
    uint64_t keys;           // mat4x3[keyCount]: object to world while the shutter is open
};

// What black bodies send, by temperature: BLACKBODY_STEPS values from 0 to BLACKBODY_LARGEST kelvin, interpolated between,
// and growing with the fourth power beyond.
HIPR_CONST uint BLACKBODY_STEPS = 256u;
HIPR_CONST float BLACKBODY_LARGEST = 12000.0f;

// Hit::primitive of a ray that met nothing: another kernel has dealt with its path.
HIPR_CONST uint HIT_TAKEN = 0xfffffffeu;

HIPR_SHARED_END
#endif
