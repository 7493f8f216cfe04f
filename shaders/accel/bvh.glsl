// Two-level traversal of binary trees with a stack in a local array.
#ifndef HIPR_ACCEL_BVH_GLSL
#define HIPR_ACCEL_BVH_GLSL
#include "shared/references.glsl"
#include "shared/bvh.h"
#include "shared/features.glsl"
#include "shared/segment.h"
#include "accel/motion.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer BvhSceneRef { BvhScene v; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer BvhInstanceRef { BvhInstance v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 64) readonly buffer BvhNodeRef { BvhNode v[]; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer BvhTriangleRef { BvhTriangle v[]; };

const uint BVH_STACK = BVH_MAX_INSTANCE_DEPTH + BVH_MAX_TRIANGLE_DEPTH;
const uint BVH_NO_BASE = 0xffffffffu;
const uint64_t BVH_TRIANGLE_BYTES = 40ul;

// The nearest hit, or with `any` some hit; `hit.instance` is NO_INDEX when there is none.
Hit traceBvh(uint64_t scene, Ray ray, uint mask, const bool any) {
    Hit hit = Hit(NO_INDEX, NO_INDEX, ray.tMax, 0.0, 0.0);
    if (scene == 0ul || !traceable(ray.origin, ray.direction, ray.tMin, ray.tMax)) return hit;
    BvhScene top = BvhSceneRef(scene).v;
    BoxRay worldBox = boxRay(ray.origin, ray.direction, top.extent);

    // The tree being walked: the top level while base == BVH_NO_BASE, else the tree of `instance`.
    uint64_t nodes = top.nodes;
    BoxRay box = worldBox;
    uint base = BVH_NO_BASE;
    uint instance = 0u;
    uint64_t triangles = 0ul;
    uint nextKey = 0u; // distance of a triangle's keys; 0: it does not deform
    float keyWeight = 0.0;
    TriangleRay triangleRay_ = TriangleRay(vec3(0.0), 0u, vec3(0.0));
    uint passed = 0u;      // sides of the instance's faces, see passedSides()
    bool segments = false; // of them `instance` is made
    SegmentRay segmentRay_ = SegmentRay(vec3(0.0), vec3(0.0), 0.0);
    float entry = 0.0, exit = 0.0; // of the instance's world box

    uint stack[BVH_STACK];
    uint depth = 0u;
    uint node = 0u;
    for (;;) {
        bool pop = true;
        if ((node & BVH_LEAF) == 0u) {
            BvhNode n = BvhNodeRef(nodes).v[node];
            float entry0, exit0, entry1, exit1;
            boxInterval(box, n.lo0, n.hi0, entry0, exit0);
            boxInterval(box, n.lo1, n.hi1, entry1, exit1);
            bool meets0 = max(entry0, ray.tMin) <= min(exit0, hit.t);
            bool meets1 = max(entry1, ray.tMin) <= min(exit1, hit.t);
            bool firstIsNear = entry0 <= entry1;
            if (meets0 && meets1) stack[depth++] = firstIsNear ? n.child1 : n.child0;
            node = meets0 && (firstIsNear || !meets1) ? n.child0 : n.child1;
            pop = !meets0 && !meets1;
        } else if (base == BVH_NO_BASE) {
            if (node != BVH_EMPTY) {
                instance = node & BVH_FIRST_MASK;
                BvhInstance record = BvhInstanceRef(top.instances).v[instance];
                boxInterval(worldBox, record.lo, record.hi, entry, exit);
                if ((record.mask & mask) != 0u && max(entry, ray.tMin) <= min(exit, hit.t)) {
                    if (record.keyCount > 0u)
                        record.worldToObject =
                            inverseTransform(transformAt(top.motionKeys, record.firstKey, record.keyCount, ray.time));
                    vec3 origin = mapPoint(record.worldToObject, ray.origin);
                    vec3 direction = mapDirection(record.worldToObject, ray.direction);
                    box = boxRay(origin, direction, record.extent);
                    segments = sceneHas(SCENE_HAS_SEGMENTS) && record.segments != 0u;
                    if (sceneHas(SCENE_HAS_CULLING)) passed = passedSides(record.culled, ray.flags);
                    if (segments)
                        segmentRay_ = segmentRay(origin, direction);
                    else
                        triangleRay_ = triangleRay(origin, direction);
                    nodes = record.nodes;
                    triangles = record.triangles;
                    nextKey = 0u;
                    if (record.geometryKeys > 1u) {
                        KeyTime at = keyTime(ray.time, record.geometryKeys);
                        nextKey = record.triangleCount;
                        keyWeight = at.weight;
                        triangles += uint64_t(at.first * nextKey) * BVH_TRIANGLE_BYTES;
                    }
                    base = depth;
                    node = 0u;
                    pop = false;
                }
            }
        } else {
            uint first = node & BVH_FIRST_MASK;
            uint last = first + ((node >> BVH_COUNT_SHIFT) & BVH_COUNT_MASK);
            for (uint i = first; i < last; ++i) {
                BvhTriangle t = BvhTriangleRef(triangles).v[i];
                if (nextKey > 0u) {
                    BvhTriangle next = BvhTriangleRef(triangles).v[i + nextKey];
                    t.a = mixKeys(t.a, next.a, keyWeight);
                    t.b = mixKeys(t.b, next.b, keyWeight);
                    t.c = mixKeys(t.c, next.c, keyWeight);
                }
                float distance, u, v;
                bool met, front = true;
                if (segments)
                    met = canonicalSegmentHit(segmentRay_, box, t.a, t.b, t.c.x, t.c.y, entry, exit, distance, u, v);
                else
                    met = canonicalHit(triangleRay_, box, t.a, t.b, t.c, entry, exit, distance, u, v, front);
                if (sceneHas(SCENE_HAS_CULLING)) met = met && !passesSide(passed, front);
                if (met && distance > ray.tMin &&
                    before(distance, instance, t.primitive, hit.t, hit.instance, hit.primitive))
                    hit = Hit(instance, t.primitive, distance, u, v);
            }
            if (any && hit.instance != NO_INDEX) return hit;
        }
        if (pop) {
            if (depth == base) {
                base = BVH_NO_BASE;
                nodes = top.nodes;
                box = worldBox;
            }
            if (depth == 0u) return hit;
            node = stack[--depth];
        }
    }
}
#endif
