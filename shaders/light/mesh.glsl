// Meshes with an emissive material as lights. One light is one instance; of its triangles one is chosen by area and
// emission, in object space, so that all instances share one table (renderer/scene/mesh_lights.h), and of that a point,
// uniform in area. Both sides emit, as materials do. What the point emits is left to the kernel `emission`.
#ifndef HIPR_LIGHT_MESH_GLSL
#define HIPR_LIGHT_MESH_GLSL
#include "light/environment.glsl"
#include "trace/offset.glsl"

// A corner of a triangle of an instance, and the two edges from there, in world space.
void worldTriangle(SceneRecord scene, uint instance, uint triangle, out vec3 corner, out vec3 e1, out vec3 e2) {
    InstanceRecord record = InstanceRef(scene.instances).v[instance];
    GeometryRecord geometry = GeometryRef(scene.geometries).v[record.geometry];
    uvec3 vertices = Uvec3Ref(geometry.triangles).v[triangle];
    Vec3Ref positions = Vec3Ref(geometry.positions);
    vec3 p0 = positions.v[vertices.x];
    mat3 linear = mat3(record.objectToWorld);
    corner = record.objectToWorld * vec4(p0, 1.0);
    e1 = linear * (positions.v[vertices.y] - p0);
    e2 = linear * (positions.v[vertices.z] - p0);
}

// Density per solid angle of a point at distance `t` in the unit direction `wi`, uniform on a triangle with the edges' cross
// product `normal` that is chosen with `chance`. 0: seen edge on.
float trianglePdf(vec3 normal, float chance, float t, vec3 wi) {
    float facing = 0.5 * abs(dot(normal, wi)); // the triangle's area times the cosine
    return facing > 0.0 ? chance * t * t / facing : 0.0;
}

// Uniform weights of corners 1 and 2: E. Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
vec2 sampleTriangle(vec2 u) {
    if (u.y > u.x) {
        u.x *= 0.5;
        u.y -= u.x;
    } else {
        u.y *= 0.5;
        u.x -= u.y;
    }
    return u;
}

// Draws a point of a LIGHT_MESH seen from `p`. u.x chooses the triangle, and its place between that one's limits goes on.
bool sampleMesh(SceneRecord scene, LightRecord light, vec3 p, vec2 u, out vec3 wi, out float pdf, out Hit point) {
    float chance;
    uint triangle = invertCumulative(FloatRef(light.distribution), 0u, light.triangleCount, u.x, chance);
    vec2 uv = sampleTriangle(u);
    vec3 corner, e1, e2;
    worldTriangle(scene, light.instance, triangle, corner, e1, e2);
    vec3 normal = cross(e1, e2), target = corner + uv.x * e1 + uv.y * e2;
    vec3 outside = normal * inversesqrt(max(dot(normal, normal), 1e-38));
    float height = dot(outside, p - target), restless = restlessHeight(e1, e2);
    vec3 way = offsetOrigin(target, height < 0.0 ? -outside : outside, restless) - p; // not to block its own light
    float t = length(way);
    wi = way / t;
    // In its own plane a triangle is not seen: what offset and rounding show of it there is not light.
    pdf = abs(height) <= restless ? 0.0 : trianglePdf(normal, chance, t, (target - p) / t);
    point = Hit(light.instance, triangle, t, uv.x, uv.y);
    return t > 0.0 && pdf > 0.0;
}

// The density with which sampleMesh draws the point that a ray in the unit direction `wi` has met, once it has the light.
float meshPdf(SceneRecord scene, LightRecord light, Hit hit, vec3 wi) {
    FloatRef sums = FloatRef(light.distribution);
    vec3 corner, e1, e2;
    worldTriangle(scene, hit.instance, hit.primitive, corner, e1, e2);
    return trianglePdf(cross(e1, e2), sums.v[hit.primitive + 1u] - sums.v[hit.primitive], hit.t, wi);
}
#endif
