// Primvars at a hit.
#ifndef HIPR_MATERIAL_PRIMVAR_GLSL
#define HIPR_MATERIAL_PRIMVAR_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "shared/features.glsl"
#include "shared/references.glsl"

// A primvar's values at the three corners of the hit triangle. One component is spread to three, missing ones are 0, and
// the fourth is 1 where absent.
struct PrimvarCorners {
    vec4 a, b, c;
    bool found;
};

vec4 readPrimvarValue(PrimvarRecord primvar, uint element) {
    FloatRef values = FloatRef(primvar.values);
    uint first = element * primvar.components;
    vec4 value = vec4(0.0, 0.0, 0.0, 1.0);
    value.x = values.v[first];
    if (primvar.components == 1u) return vec4(vec3(value.x), 1.0);
    value.y = values.v[first + 1u];
    if (primvar.components > 2u) value.z = values.v[first + 2u];
    if (primvar.components > 3u) value.w = values.v[first + 3u];
    return value;
}

// Looks a primvar up by its interned name: the instance's own first, then the geometry's.
PrimvarCorners findPrimvar(InstanceRecord instance, GeometryRecord geometry, uint primitive, uvec3 vertices, uint name) {
    PrimvarCorners corners;
    corners.found = false;
    corners.a = corners.b = corners.c = vec4(0.0);
    PrimvarRecord primvar;
    uint total = instance.primvarCount + geometry.primvarCount;
    [[dont_unroll]] for (uint i = 0u; i < total && !corners.found; ++i) {
        bool own = i < instance.primvarCount;
        primvar = PrimvarRef(own ? instance.primvars : geometry.primvars).v[own ? i : i - instance.primvarCount];
        corners.found = primvar.name == name;
    }
    if (!corners.found) return corners;
    uvec3 elements = vertices;
    if (primvar.interpolation == INTERPOLATION_CONSTANT) elements = uvec3(0u);
    if (primvar.interpolation == INTERPOLATION_UNIFORM) {
        const bool curves = sceneHas(SCENE_HAS_SEGMENTS) && geometry.radii != 0ul;
        elements = uvec3(curves ? UintRef(geometry.triangleFace).v[primitive] : primitive);
    }
    if (primvar.interpolation == INTERPOLATION_FACE_VARYING) elements = 3u * primitive + uvec3(0u, 1u, 2u);
    [[dont_unroll]] for (int k = 0; k < 3; ++k) {
        corners.a = corners.b; // rotates through the corners, so that one read serves all three
        corners.b = corners.c;
        corners.c = readPrimvarValue(primvar, k == 0 ? elements.x : (k == 1 ? elements.y : elements.z));
    }
    return corners;
}

// Exact where all corners are equal, for graphs that ask whether a number of faces is a certain one.
vec4 interpolatePrimvar(PrimvarCorners corners, vec2 uv) {
    const vec4 between = corners.a * (1.0 - uv.x - uv.y) + corners.b * uv.x + corners.c * uv.y;
    return mix(between, corners.a, equal(abs(corners.b - corners.a) + abs(corners.c - corners.a), vec4(0.0)));
}
#endif
