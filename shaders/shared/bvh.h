// What the traversals know about the scene. Every table is in instance order or in tree order, never both.
#ifndef HIPR_SHARED_BVH_H
#define HIPR_SHARED_BVH_H
#include "language.h"
HIPR_SHARED_BEGIN

// A child reference is the index of an inner node, or a leaf: flag, number of primitives, first primitive.
HIPR_CONST uint BVH_LEAF = 0x80000000u;
HIPR_CONST uint BVH_COUNT_SHIFT = 27u;
HIPR_CONST uint BVH_COUNT_MASK = 15u;
HIPR_CONST uint BVH_FIRST_MASK = 0x07ffffffu;
HIPR_CONST uint BVH_EMPTY = BVH_LEAF; // a leaf without primitives

// Depth limits the builder keeps; together they size the traversal stack.
HIPR_CONST uint BVH_MAX_INSTANCE_DEPTH = 24u;
HIPR_CONST uint BVH_MAX_TRIANGLE_DEPTH = 38u;

// Inner node of a binary tree with the boxes of both children: one cache line.
struct BvhNode {
    vec3 lo0;
    uint child0;
    vec3 hi0;
    uint child1;
    vec3 lo1;
    uint pad0;
    vec3 hi1;
    uint pad1;
};

// Leaf triangle, vertices inlined: one fetch instead of three dependent ones. A round segment (segment.h) has its second
// vertex in b, and the radii at both in c.x and c.y.
struct BvhTriangle {
    vec3 a;
    vec3 b;
    vec3 c;
    uint primitive; // index in the geometry
};

// An instance as a leaf of the top level.
struct BvhInstance {
    mat4x3 worldToObject;
    vec3 lo;                 // world box of all times, already conservative (see renderer/accel/instance_table.h)
    vec3 hi;
    float extent;            // largest |coordinate| of the geometry at any time, object space
    uint mask;               // RAY_MASK_* bit of this instance; 0: holds nothing
    uint64_t nodes;          // BvhNode[], 0 when the traversal has its own trees
    uint64_t triangles;      // BvhTriangle[geometryKeys][triangleCount], likewise
    uint firstKey;           // as InstanceRecord has them
    uint keyCount;
    uint geometryKeys;       // GeometryRecord::keys
    uint triangleCount;      // or of segments
    uint segments;           // 1: the geometry is made of round segments, 0: of triangles
    uint culled;             // INSTANCE_CULL_*
};

// Root of the table, at SceneRecord::bvh.
struct BvhScene {
    uint64_t nodes;          // BvhNode[] of the top level; leaves hold one instance, `first` is its index
    uint64_t instances;      // BvhInstance[]
    uint64_t motionKeys;     // mat4x3[], or 0
    float extent;            // largest |coordinate| of all instance boxes
    uint instanceCount;
    uint culls;              // 1: some instance has INSTANCE_CULL_*
    uint pad;
};

HIPR_SHARED_END
#endif
