// Scene tables read by every kernel. Addresses are buffer device addresses (0: none).
#ifndef HIPR_SHARED_SCENE_H
#define HIPR_SHARED_SCENE_H
#include "language.h"
HIPR_SHARED_BEGIN

HIPR_CONST uint NO_INDEX = 0xffffffffu;

HIPR_CONST uint GEOMETRY_DOUBLE_SIDED = 1u;
HIPR_CONST uint GEOMETRY_NORMALS_FACE_VARYING = 2u; // else per vertex; normals == 0: geometric normals

// One triangle mesh, or round segments (segment.h): then `triangles` has the first vertex of each, the second one is the
// next, and what is said of triangles below is meant of segments.
struct GeometryRecord {
    uint64_t positions;      // vec3[keys][vertexCount]
    uint64_t triangles;      // uvec3[triangleCount], or uint[triangleCount]
    uint64_t radii;          // float[vertexCount] of segments; 0: triangles
    uint64_t normals;        // vec3[keys][vertexCount or 3 * triangleCount]
    uint64_t triangleFace;   // uint[triangleCount]
    uint64_t triangleSlot;   // uint16_t[triangleCount], 0 address: slot 0
    uint64_t primvars;       // PrimvarRecord[primvarCount]
    uint triangleCount;
    uint vertexCount;
    uint primvarCount;
    uint flags;              // GEOMETRY_*
    uint keys;               // 1: does not deform while the shutter is open; else see motion.h
    uint pad;
};

HIPR_CONST uint INTERPOLATION_CONSTANT = 0u;
HIPR_CONST uint INTERPOLATION_UNIFORM = 1u;
HIPR_CONST uint INTERPOLATION_VERTEX = 2u;
HIPR_CONST uint INTERPOLATION_FACE_VARYING = 3u;

// A primvar of a geometry or of an instance (then always constant). Names are interned to ids by the host.
struct PrimvarRecord {
    uint64_t values;         // float[components * count]
    uint name;
    uint interpolation;      // INTERPOLATION_*
    uint components;         // 1..4
    uint pad;
};

HIPR_CONST uint INSTANCE_NON_OPAQUE = 1u; // some slot's material may let rays through without refraction
HIPR_CONST uint INSTANCE_MIRRORED = 2u;   // object-to-world flips handedness
HIPR_CONST uint INSTANCE_CULL_BACK = 4u;  // rays of the camera pass back faces; others do not
HIPR_CONST uint INSTANCE_CULL_FRONT = 8u; // or front faces; never both
HIPR_CONST uint INSTANCE_CULL_FOR_LIGHT = 16u; // all rays pass them
HIPR_CONST uint INSTANCE_CULLS = 28u;     // all of these

// One placement of one object: a leaf of the top-level acceleration structure.
struct InstanceRecord {
    mat4x3 objectToWorld;
    mat4x3 worldToObject;
    uint geometry;           // index of a GeometryRecord
    uint firstMaterial;      // into the material index table: slot s of this object uses entry firstMaterial + s
    uint materialCount;      // slots beyond it use the last entry
    uint flags;              // INSTANCE_*
    int primId;
    int instanceId;
    uint object;             // ObjectId value, for HiPR's changed set
    uint primvarCount;
    uint64_t primvars;       // PrimvarRecord[primvarCount], constant, override the geometry's
    uint objectInstance;     // which of the object's instances: index into InstancesDesc::transforms
    uint categories;         // set of categories, for light linking
    uint firstKey;           // into SceneRecord::motionKeys: object-to-world while the shutter is open
    uint keyCount;           // 0: stands still
};

// A ray as the trace queues hold it. tMin is 0: origins are offset off their surface.
struct Ray {
    vec3 origin;
    float tMin;
    vec3 direction;          // unit length
    float tMax;
    float time;              // of the shutter: 0 when it opens, 1 when it closes
    uint flags;              // RAY_*
};
HIPR_CONST uint RAY_OF_CAMERA = 1u; // nothing has scattered it: it passes what instances hide from the camera

// The nearest hit. u, v are the barycentric weights of vertices 1 and 2, or those of intersectSegment().
struct Hit {
    uint instance;           // NO_INDEX: miss
    uint primitive;
    float t;
    float u;
    float v;
};

// What a slot of an object is called.
struct SlotNames {
    float object;            // Cryptomatte ids
    float material;
    float asset;
    uint lightGroup;         // interned name, NO_INDEX: none
};

// Everything a kernel may read about the scene; one buffer, rewritten on commit.
struct SceneRecord {
    uint64_t geometries;     // GeometryRecord[]
    uint64_t instances;      // InstanceRecord[]
    uint64_t materialIndices;// uint[]
    uint64_t slotNames;      // SlotNames[], one for each of those, or 0
    uint64_t materials;      // MaterialRecord[] (shaders/shared/material.h); entry 0 is the fallback look
    uint64_t textures;       // TextureRecord[]
    uint64_t lights;         // LightRecord[]  (shaders/shared/light.h)
    uint64_t lightCumulative;// float[lightCount]: sums of the chances of lights, those of the tree as one
    uint64_t lightNodes;     // LightNode[lightNodeCount]: all lights but infinite ones
    uint64_t instanceLights; // uint[instanceCount]: the LIGHT_MESH of an instance, NO_INDEX: none; or 0: there is none
    uint64_t motionKeys;     // mat4x3[], or 0
    uint64_t bvh;            // root of the GLSL traversal's structures, or 0
    uint instanceCount;
    uint lightCount;
    uint areaLightCount;     // the first lights have a shape a ray can hit
    uint infiniteLightCount; // the last of all lights are dome or distant ones
    uint lightNodeCount;
    float lightTreeChance;   // of choosing by the tree; 0: it is there for rays alone
    vec3 boundsMin;          // world bounds of all instances
    vec3 boundsMax;
    uint flags;              // SCENE_*
    uint categoryWords;
    uint64_t specularAlbedo; // vec2[]: see renderer/shading/albedo.h
    uint64_t openPbrAlbedo;  // tables of renderer/shading/openpbr_albedo.h; 0 without a material of that model
    uint64_t stretchedAlbedo; // vec2[]: see renderer/shading/stretched_albedo.h; 0 without a material that needs it
    uint64_t categorySets;   // uint[][1 + categoryWords]: mark and bits of sets of categories, see renderer/shading/categories.h
    uint64_t volumes;        // VolumeRecord[volumeCount] (shaders/shared/volume.h)
    uint64_t blackbody;      // vec3[BLACKBODY_STEPS]; 0 without volumes
    uint volumeCount;
};

HIPR_CONST uint SCENE_HAS_NON_OPAQUE = 1u;
HIPR_CONST uint SCENE_DOME_HIDDEN_FROM_CAMERA = 2u;
HIPR_CONST uint SCENE_HAS_SHADOWS_TO_WALK = 4u; // some light has a ShadowRecord
HIPR_CONST uint SCENE_HAS_MESH_LIGHTS = 8u;

HIPR_CONST uint SCENE_HAS_OPENPBR = 16u;        // some material of the scene is of that model
HIPR_CONST uint SCENE_HAS_GRAPHS = 32u;         // some material's program has other steps than GRAPH_READ
HIPR_CONST uint SCENE_HAS_VOLUMES = 64u;
HIPR_CONST uint SCENE_HAS_MOTION = 128u;        // some object moves or deforms while the shutter is open
HIPR_CONST uint FILM_SORTS_LIGHT = 256u;        // the film has light path expressions
HIPR_CONST uint SCENE_HAS_CULLING = 512u;       // some instance has INSTANCE_CULL_*: for the kernels that trace
HIPR_CONST uint SCENE_HAS_NESTING = 1024u;      // some refractive material has a MaterialRecord::priority other than 0
HIPR_CONST uint SCENE_HAS_SEGMENTS = 2048u;     // some geometry is made of round segments
HIPR_CONST uint SCENE_HAS_DIRECTIONS = 8192u;   // some material's program makes INPUT_COAT_NORMAL or a tangent
// Those that kernels which shade are specialised by: what the scene does not have is not in their code.
HIPR_CONST uint SCENE_SHADING_FEATURES =
    SCENE_HAS_MESH_LIGHTS | SCENE_HAS_OPENPBR | SCENE_HAS_GRAPHS | SCENE_HAS_MOTION | FILM_SORTS_LIGHT |
    SCENE_HAS_NESTING | SCENE_HAS_SEGMENTS | SCENE_HAS_DIRECTIONS;

HIPR_SHARED_END
#endif
