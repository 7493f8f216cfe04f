// Traversal by VK_KHR_ray_query. The driver proposes triangles, shared/intersect.h decides, as with Embree on the host.
#ifndef HIPR_ACCEL_RAY_QUERY_GLSL
#define HIPR_ACCEL_RAY_QUERY_GLSL
#extension GL_EXT_ray_query : require
#include "shared/references.glsl"
#include "shared/bvh.h"
#include "shared/segment.h"

layout(set = 0, binding = 0) uniform accelerationStructureEXT sceneTree;
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer BvhSceneRef { BvhScene v; };
layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer BvhInstanceRef { BvhInstance v[]; };

const float QUERY_WINDOW = 8.0 * BOX_ALLOWANCE; // the driver's distances differ from canonical ones by rounding
const float QUERY_FAR = 3e38;                   // drivers want finite intervals
const float QUERY_RADIUS = 4.0;                 // of rays beside one, in allowances
const float QUERY_SLOPE = 32.0;                 // surfaces up to this steep stay in the window of rays beside
const uint QUERY_SIDES = 8u;                    // rays around one that hits an edge
const uint QUERY_LIMIT = 256u;                  // proposals turned down before a ray counts as a miss

struct Candidates {
    Hit best;
    bool edge;        // `best` lies on an edge
    float turnedDown; // distance of a proposal the canonical test did not confirm, else QUERY_FAR
};

// Tests a proposed triangle against the ray as it was given. False: the ray passes this side of it.
bool consider(inout Candidates c, SceneRecord scene, Ray ray, uint instance, uint primitive, float proposed) {
    BvhScene top = BvhSceneRef(scene.bvh).v;
    BvhInstance record = BvhInstanceRef(top.instances).v[instance];
    GeometryRecord geometry = GeometryRef(scene.geometries).v[InstanceRef(scene.instances).v[instance].geometry];
    uvec3 corner = Uvec3Ref(geometry.triangles).v[primitive];
    vec3 a = Vec3Ref(geometry.positions).v[corner.x];
    vec3 b = Vec3Ref(geometry.positions).v[corner.y];
    vec3 d = Vec3Ref(geometry.positions).v[corner.z];
    vec3 origin = mapPoint(record.worldToObject, ray.origin);
    vec3 direction = mapDirection(record.worldToObject, ray.direction);
    float entry, exit, t, u, v;
    bool front;
    boxInterval(boxRay(ray.origin, ray.direction, top.extent), record.lo, record.hi, entry, exit);
    if (!canonicalHit(triangleRay(origin, direction), boxRay(origin, direction, record.extent), a, b, d, entry, exit, t,
                      u, v, front)) {
        c.turnedDown = min(c.turnedDown, proposed);
    } else if (passesSide(passedSides(record.culled, ray.flags), front)) {
        return false;
    } else if (t > ray.tMin && before(t, instance, primitive, c.best.t, c.best.instance, c.best.primitive)) {
        c.best = Hit(instance, primitive, t, u, v);
        c.edge = onEdge(u, v);
    }
    return true;
}

// Tests a segment in whose box the ray is, and returns its distance, QUERY_FAR: a miss.
float considerSegment(inout Candidates c, SceneRecord scene, Ray ray, uint instance, uint primitive) {
    BvhScene top = BvhSceneRef(scene.bvh).v;
    BvhInstance record = BvhInstanceRef(top.instances).v[instance];
    if (passesSide(passedSides(record.culled, ray.flags), true)) return QUERY_FAR;
    GeometryRecord geometry = GeometryRef(scene.geometries).v[InstanceRef(scene.instances).v[instance].geometry];
    uint first = UintRef(geometry.triangles).v[primitive];
    vec3 origin = mapPoint(record.worldToObject, ray.origin);
    vec3 direction = mapDirection(record.worldToObject, ray.direction);
    float entry, exit, t, u, v;
    boxInterval(boxRay(ray.origin, ray.direction, top.extent), record.lo, record.hi, entry, exit);
    if (!canonicalSegmentHit(segmentRay(origin, direction), boxRay(origin, direction, record.extent),
                             Vec3Ref(geometry.positions).v[first], Vec3Ref(geometry.positions).v[first + 1u],
                             FloatRef(geometry.radii).v[first], FloatRef(geometry.radii).v[first + 1u], entry, exit, t,
                             u, v) ||
        !(t > ray.tMin))
        return QUERY_FAR;
    if (before(t, instance, primitive, c.best.t, c.best.instance, c.best.primitive)) {
        c.best = Hit(instance, primitive, t, u, v);
        c.edge = false;
    }
    return t;
}

// The nearest hit, or with `any` some hit. In three kinds of query: search (the driver's nearest hit), window (all its
// candidates around that distance, for equal distances), sides (the same along rays next to it, for triangles that
// share an edge or a corner there). Most rays need the first two.
Hit traceRayQuery(SceneRecord scene, Ray ray, uint mask, const bool any) {
    Candidates c = Candidates(Hit(NO_INDEX, NO_INDEX, ray.tMax, 0.0, 0.0), false, QUERY_FAR);
    if (scene.bvh == 0ul || !traceable(ray.origin, ray.direction, ray.tMin, ray.tMax)) return c.best;
    float allowance = rayAllowance(ray.origin, BvhSceneRef(scene.bvh).v.extent);
    vec3 across0, across1;
    acrossAxis(ray.direction, across0, across1);

    // Triangles of instances that cull are proposed even so, for a ray may pass the nearest.
    const uint searchFlags = BvhSceneRef(scene.bvh).v.culls != 0u ? gl_RayFlagsNoneEXT : gl_RayFlagsOpaqueEXT;
    float last = min(ray.tMax * (1.0 + QUERY_WINDOW), QUERY_FAR);
    float from = ray.tMin, to = last;
    bool searching = true;
    uint side = 0u; // next of the rays around; 0: the ray itself
    for (uint round = 0u; round < QUERY_LIMIT; ++round) {
        vec3 origin = ray.origin;
        if (side > 0u) {
            float angle = float(side - 1u) * (6.2831853 / float(QUERY_SIDES));
            origin += (QUERY_RADIUS * allowance) * (cos(angle) * across0 + sin(angle) * across1);
        }
        rayQueryEXT query;
        uint flags = searching && !any ? searchFlags : gl_RayFlagsNoOpaqueEXT;
        rayQueryInitializeEXT(query, sceneTree, flags, mask, origin, from, ray.direction, to);
        while (rayQueryProceedEXT(query)) {
            const uint instance = uint(rayQueryGetIntersectionInstanceIdEXT(query, false));
            const uint primitive = uint(rayQueryGetIntersectionPrimitiveIndexEXT(query, false));
            if (rayQueryGetIntersectionTypeEXT(query, false) == gl_RayQueryCandidateIntersectionAABBEXT) {
                const float t = considerSegment(c, scene, ray, instance, primitive);
                const bool none = rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT;
                if (t >= from && t <= (none ? to : rayQueryGetIntersectionTEXT(query, true)))
                    rayQueryGenerateIntersectionEXT(query, t);
            } else if (consider(c, scene, ray, instance, primitive,
                                searching ? rayQueryGetIntersectionTEXT(query, false) : QUERY_FAR)) {
                if (searching && !any) rayQueryConfirmIntersectionEXT(query);
            }
            if (any && c.best.instance != NO_INDEX) return c.best;
        }
        if (searching) {
            float t = c.turnedDown; // with `any`: all candidates were tested, look around one turned down
            if (!any)
                t = rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT
                        ? QUERY_FAR
                        : rayQueryGetIntersectionTEXT(query, true);
            if (t >= QUERY_FAR) return c.best;
            float window = max(t * QUERY_WINDOW, QUERY_SLOPE * QUERY_RADIUS * allowance);
            from = max(t - window, 0.0);
            to = t + window;
            searching = false;
            side = any ? 1u : 0u;
        } else {
            bool found = c.best.instance != NO_INDEX && c.best.t <= to; // a segment may be behind
            if (found && !c.edge) return c.best;
            if (side < QUERY_SIDES) {
                ++side;
            } else {
                if (found || any || to >= last) return c.best;
                from = to; // nothing here after all: go on behind it
                to = last;
                searching = true;
                side = 0u;
            }
        }
    }
    return c.best;
}
#endif
