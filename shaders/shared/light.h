// Lights. Area lights come first in the table, then thin ones, then meshes, then infinite ones (see SceneRecord).
#ifndef HIPR_SHARED_LIGHT_H
#define HIPR_SHARED_LIGHT_H
#include "language.h"
HIPR_SHARED_BEGIN

HIPR_CONST uint LIGHT_DOME = 0u; // values of hipr::LightKind
HIPR_CONST uint LIGHT_DISTANT = 1u;
HIPR_CONST uint LIGHT_RECT = 2u;
HIPR_CONST uint LIGHT_SPHERE = 3u;
HIPR_CONST uint LIGHT_DISK = 4u;
HIPR_CONST uint LIGHT_CYLINDER = 5u;
HIPR_CONST uint LIGHT_THIN = 6u;     // a point, or a line along local X: LightDesc::thin
HIPR_CONST uint LIGHT_MESH = 7u;     // an instance that shows an emissive material: see shaders/light/mesh.glsl

// What a light's radiance is multiplied by, by the direction it leaves in: see shaders/light/shaping.glsl.
struct ShapingRecord {
    vec3 focusTint;
    float focus;             // 0: none
    float coneAngle;         // radians, PI and more: none
    float coneStart;         // where it begins to fade
    float iesAngleScale;
    float iesFactor;
    uint64_t profile;        // float[profileRows * profileColumns], 0: none. Rows from angle 0 to PI off the axis,
                             // columns from 0 to 2 PI around it, both ends included; one column: the same all around
    uint profileRows;
    uint profileColumns;
};

// A node of the tree of all lights but infinite ones, in depth-first order: see shaders/light/tree.glsl.
struct LightNode {
    vec3 lo;
    float power;
    vec3 hi;
    uint next;               // node to go on with when this one's lights are passed over; of the last ones: their number
    vec3 axis;               // normals of the lights lie within a cone around it
    float cosSpread;         // cosine of that cone's angle
    float cosEmission;       // of the angle off the normals within which light leaves
    uint light;              // leaf: index of a LightRecord, NO_INDEX: has children
    uint links;              // marks of the categories that its lights light (renderer/shading/categories.h), NO_INDEX: all
};

// Shadows that are not plain: what gets through occluders and which objects are any. See shaders/light/shadow.glsl.
struct ShadowRecord {
    vec3 color;
    float fadeStart;         // distances of an occluder from the lit point
    float end;
    float gamma;
    uint category;           // of the objects that cast shadows, NO_INDEX: all
    uint instance;           // of a mesh, whose own surface casts plain shadows; NO_INDEX: another light
};

// An emitter: radiance on a shape. Emitters are ghosts: rays that cross one collect its emission and go on, so
// emitters neither block nor shadow each other, and NEE needs no light-light occlusion.
struct LightRecord {
    mat4x3 lightToWorld;     // unit shapes: rect [-.5,.5]^2 scaled by size, sphere/disk radius, cylinder length along X
    mat4x3 worldToLight;
    vec3 radiance;           // nits in render RGB, normalisation and exposure folded in; thin: radiance times area, over 4
                             // (point) or PI (line), so that what arrives is that over the squared distance
    uint kind;               // LIGHT_*
    vec2 size;               // rect: width, height; sphere, disk: radius; cylinder: radius, length; thin: 0, length; distant: cos of half angle
    float area;              // world area (area lights), solid angle (distant)
    float selectPdf;         // probability that NEE picks this light, or, of a leaf of the tree, the tree
    uint texture;            // TextureRecord or NO_INDEX
    uint group;              // interned name for light path expressions, NO_INDEX: none
    float diffuse;
    float specular;
    uint64_t distribution;   // dome: piecewise-constant sampling table, see shaders/light/environment.glsl; mesh: sums of
                             // the chances of its triangles, float[triangleCount + 1] from 0 to 1; 0: it moves, and rays
                             // alone find it
    uint distributionWidth;
    uint distributionHeight;
    uint64_t shaping;        // ShapingRecord, 0: none
    uint64_t shadow;         // ShadowRecord, 0: plain shadows
    uint category;           // of the objects that are lit, NO_INDEX: all
    uint leaf;               // in the tree of lights: its LightNode
    uint instance;           // mesh: its InstanceRecord
    uint triangleCount;      // mesh
};

HIPR_SHARED_END
#endif
