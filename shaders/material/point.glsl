// Where a ray has hit: the triangle or round segment, and the frame there.
#ifndef HIPR_MATERIAL_POINT_GLSL
#define HIPR_MATERIAL_POINT_GLSL
#include "accel/motion.glsl"
#include "material/frame.glsl"
#include "material/slot.glsl"
#include "shared/features.glsl"
#include "shared/references.glsl"
#include "shared/segment.h"

// What a material reads at a hit: the triangle it is on, and where on it. A segment is a triangle whose third vertex is the
// first once more, but for its surface.
struct ShadingPoint {
    InstanceRecord instance;
    GeometryRecord geometry;
    uint primitive;
    uvec3 vertices;
    vec2 uv; // barycentric weights of vertices 1 and 2
    bool onSegment;
    vec2 place;   // on a segment: what intersectSegment() has found
    KeyTime at;   // between keys, where
    bool deforms; // is true
    float footprint;  // what the ray covers, as a share of the parallelogram of the triangle's edges; 0: nothing, so that
    float levelShare; // textures are read at their finest. 0..1: the share of paths that take the finer of two levels
};

ShadingPoint shadingPoint(SceneRecord scene, Hit hit) {
    ShadingPoint point;
    point.instance = InstanceRef(scene.instances).v[hit.instance];
    point.geometry = GeometryRef(scene.geometries).v[point.instance.geometry];
    point.primitive = hit.primitive;
    point.place = point.uv = vec2(hit.u, hit.v);
    point.onSegment = sceneHas(SCENE_HAS_SEGMENTS) && point.geometry.radii != 0ul;
    if (point.onSegment) {
        const uint first = UintRef(point.geometry.triangles).v[hit.primitive];
        point.vertices = uvec3(first, first + 1u, first);
        point.uv = vec2(clamp(hit.u, 0.0, 1.0), 0.0);
    } else {
        point.vertices = Uvec3Ref(point.geometry.triangles).v[hit.primitive];
    }
    point.at = KeyTime(0u, 0.0);
    point.deforms = false;
    point.footprint = point.levelShare = 0.0;
    return point;
}

// Takes a point to where it is at a time of the shutter.
void moveTo(inout ShadingPoint point, SceneRecord scene, float time) {
    if (!sceneHas(SCENE_HAS_MOTION)) return;
    if (point.instance.keyCount > 0u) {
        point.instance.objectToWorld =
            transformAt(scene.motionKeys, point.instance.firstKey, point.instance.keyCount, time);
        point.instance.worldToObject = inverseTransform(point.instance.objectToWorld);
    }
    point.deforms = point.geometry.keys > 1u;
    point.at = keyTime(time, max(point.geometry.keys, 2u));
}

// What a triangle's corners have.
struct Corners {
    vec3 a, b, c;
};

// Elements of an array that has `count` for every key.
Corners cornersAt(ShadingPoint point, uint64_t array, uvec3 elements, uint count) {
    Vec3Ref values = Vec3Ref(array);
    if (!point.deforms) return Corners(values.v[elements.x], values.v[elements.y], values.v[elements.z]);
    const uvec3 from = elements + point.at.first * count, to = from + count;
    const float w = point.at.weight;
    return Corners(mixKeys(values.v[from.x], values.v[to.x], w), mixKeys(values.v[from.y], values.v[to.y], w),
                   mixKeys(values.v[from.z], values.v[to.z], w));
}

// The MaterialRecord of a hit's slot.
uint materialIndex(SceneRecord scene, ShadingPoint point) {
    if (point.instance.materialCount == 0u) return 0u;
    return UintRef(scene.materialIndices).v[slotIndex(point.instance, point.geometry, point.primitive)];
}

// The surface at a point, in object space.
struct PointSurface {
    vec3 position;
    vec3 e1, e2;   // edges of the triangle; along a segment, and half around it
    vec3 outwards; // of a segment: its normal
};

SegmentPoint pointOnSegment(ShadingPoint point, Corners p) {
    FloatRef radii = FloatRef(point.geometry.radii);
    return segmentPoint(p.a, p.b, radii.v[point.vertices.x], radii.v[point.vertices.y], point.place.x, point.place.y);
}

PointSurface surfaceAt(ShadingPoint point) {
    const Corners p = cornersAt(point, point.geometry.positions, point.vertices, point.geometry.vertexCount);
    PointSurface s;
    s.e1 = p.b - p.a;
    if (point.onSegment) {
        const SegmentPoint on = pointOnSegment(point, p);
        s.position = on.position;
        s.e2 = cross(on.axis, on.across) * (2.0 * on.radius);
        s.outwards = on.normal;
    } else {
        s.e2 = p.c - p.a;
        s.position = p.a + s.e1 * point.uv.x + s.e2 * point.uv.y;
        s.outwards = vec3(0.0);
    }
    return s;
}

// Front-facing geometric normal in world space, of any length; `mirrored` transforms turn the winding of triangles over.
vec3 frontNormal(ShadingPoint point, vec3 outwards, vec3 e1, vec3 e2) {
    if (point.onSegment) return outwards * mat3(point.instance.worldToObject); // times the inverse transpose
    const vec3 n = cross(e1, e2);
    return (point.instance.flags & INSTANCE_MIRRORED) != 0u ? -n : n;
}

// The normal of a smooth curve in place of its segments: across its direction, which turns from vertex to vertex. At the
// spherical ends that of the sphere, `ng`.
vec3 curveNormal(ShadingPoint point, vec3 ng) {
    const uint first = point.vertices.x, count = point.geometry.vertexCount;
    const Corners p = cornersAt(point, point.geometry.positions, uvec3(first, first + 1u, first + 2u), count);
    const vec3 before = cornersAt(point, point.geometry.positions, uvec3(first - 1u), count).a;
    if ((point.place.x < 0.0 && before == p.a) || (point.place.x > 1.0 && p.c == p.b)) return ng;
    const SegmentPoint on = pointOnSegment(point, p);
    const vec3 along = normalizeOr(mix(p.b - before, p.c - p.a, on.along), on.axis);
    const vec3 across = normalizeOr(on.normal - along * dot(on.normal, along), on.across);
    const vec3 n = across * sqrt(1.0 - on.slope * on.slope) + along * on.slope;
    return normalizeOr(n * mat3(point.instance.worldToObject), ng);
}

// Interpolated normal in world space, on the front side.
vec3 interpolatedNormal(ShadingPoint point, vec3 ng) {
    if (point.onSegment) return curveNormal(point, ng);
    if (point.geometry.normals == 0ul) return ng;
    bool faceVarying = (point.geometry.flags & GEOMETRY_NORMALS_FACE_VARYING) != 0u;
    uvec3 at = faceVarying ? 3u * point.primitive + uvec3(0u, 1u, 2u) : point.vertices;
    const uint count = faceVarying ? 3u * point.geometry.triangleCount : point.geometry.vertexCount;
    const Corners normals = cornersAt(point, point.geometry.normals, at, count);
    vec3 n = normals.a * (1.0 - point.uv.x - point.uv.y) + normals.b * point.uv.x + normals.c * point.uv.y;
    n = normalizeOr(n * mat3(point.instance.worldToObject), ng); // times the inverse transpose
    return dot(n, ng) < 0.0 ? -n : n;
}

// Along the texture coordinate s on the surface whose normal is `n`; `otherwise` where it has no direction.
vec3 tangentAlong(vec3 n, vec3 otherwise, vec3 e1, vec3 e2, vec4 stEdges) {
    float det = stEdges.x * stEdges.w - stEdges.y * stEdges.z;
    vec3 dpds = (e1 * stEdges.w - e2 * stEdges.y) * sign(det);
    return normalizeOr(dpds - n * dot(n, dpds), otherwise);
}
#endif
