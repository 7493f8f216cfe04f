// Runs the program of a material at a hit.
#ifndef HIPR_MATERIAL_GRAPH_GLSL
#define HIPR_MATERIAL_GRAPH_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "material/point.glsl"
#include "material/primvar.glsl"
#include "material/texture.glsl"
#include "shared/graph_value.h"

vec4 selectChannel(vec4 value, uint channel) {
    if (channel == 0u) return value.xxxx;
    if (channel == 1u) return value.yyyy;
    if (channel == 2u) return value.zzzz;
    if (channel == 3u) return value.wwww;
    return value;
}

vec2 transformSt(InputNode node, vec2 st) { return node.uvAxisU * st.x + node.uvAxisV * st.y + node.uvOffset; }

// A UsdUVTexture: scale and bias apply to what the file holds, not to the fallback. `area` is what the ray covers of the
// texture, whose area is 1.
vec4 sampleTextureNode(SceneRecord scene, InputNode node, vec2 st, float area, float levelShare) {
    uint record = node.texture;
    if (node.udimTiles > 0u) {
        vec2 tile = floor(st);
        float number = tile.x + 10.0 * tile.y;
        bool exists = tile.x >= 0.0 && tile.x < 10.0 && number >= 0.0 && number < float(node.udimTiles);
        if (!exists) return node.fallback;
        record += uint(number);
        st -= tile;
    }
    TextureRecord texture = TextureRef(scene.textures).v[record];
    if (texture.format == TEXEL_NONE) return node.fallback;
    uint level = textureLevel(texture, area, levelShare);
    if (level > 0u) texture = TextureRef(scene.textures).v[texture.firstCoarser + level - 1u];
    return sampleTexture(texture, st) * node.scale + node.bias;
}

// What a program in progress knows.
struct GraphReader {
    SceneRecord scene;
    ShadingPoint point;
    uint64_t constants, nodes;
    PrimvarCorners corners; // of the primvar read last
    uint cornersName;
    vec4 edges;             // its first two components, through the node's transform: corners 1 and 2 minus corner 0
};

// At module scope, for functions get copies of their arguments.
vec4 graphRegisters[GRAPH_REGISTERS];

GraphReader graphReader(SceneRecord scene, ShadingPoint point, MaterialRecord material) {
    GraphReader reader;
    reader.scene = scene;
    reader.point = point;
    reader.constants = material.constants;
    reader.nodes = material.nodes;
    reader.cornersName = NO_INDEX;
    return reader;
}

vec4 graphOperand(GraphReader reader, uint operand) {
    if (operand >= GRAPH_CONSTANT) return Vec4Ref(reader.constants).v[operand - GRAPH_CONSTANT];
    return graphRegisters[min(operand, GRAPH_REGISTERS - 1u)];
}

// Edges of the triangle in world space, and the front side's normal.
mat3 graphFrame(ShadingPoint point) {
    const PointSurface s = surfaceAt(point);
    mat3 toWorld = mat3(point.instance.objectToWorld);
    vec3 e1 = toWorld * s.e1, e2 = toWorld * s.e2;
    vec3 ng = frontNormal(point, s.outwards, e1, e2);
    return mat3(e1, e2, interpolatedNormal(point, normalizeOr(ng, vec3(0.0, 0.0, 1.0))));
}

// Between object and world space: `immediate` as for GRAPH_TRANSFORM.
vec3 graphTransform(InstanceRecord instance, vec3 v, uint immediate) {
    bool toWorld = (immediate & GRAPH_WORLD) != 0u;
    mat4x3 there = toWorld ? instance.objectToWorld : instance.worldToObject;
    if ((immediate & GRAPH_AS_NORMAL) != 0u) {
        vec3 n = v * mat3(toWorld ? instance.worldToObject : instance.objectToWorld);
        return normalizeOr(n, v);
    }
    return there * vec4(v, (immediate & GRAPH_AS_VECTOR) != 0u ? 0.0 : 1.0);
}

// A direction of the surface: its normal, or along the texture coordinates.
vec3 graphDirection(ShadingPoint point, uint op, uint immediate, vec4 edges) {
    mat3 frame = graphFrame(point);
    vec3 n = frame[2];
    if (op == GRAPH_NORMAL)
        return immediate == GRAPH_WORLD ? n : graphTransform(point.instance, n, GRAPH_OBJECT | GRAPH_AS_NORMAL);
    vec3 tangent = tangentAlong(n, frameAround(n)[0], frame[0], frame[1], edges);
    if (op == GRAPH_TANGENT) return tangent;
    vec3 dpdt = (frame[1] * edges.x - frame[0] * edges.z) * sign(edges.x * edges.w - edges.y * edges.z);
    vec3 bitangent = cross(n, tangent);
    return dot(bitangent, dpdt) < 0.0 ? -bitangent : bitangent;
}

// A step before GRAPH_FIRST_PURE.
vec4 graphRead(inout GraphReader reader, uint op, uint immediate, vec4 a) {
    InputNode node;
    bool named = op == GRAPH_READ || op == GRAPH_TANGENT || op == GRAPH_BITANGENT, reads = op == GRAPH_READ;
    vec2 st = a.xy;
    vec4 value = vec4(0.0);
    float area = 0.0; // nothing is known of how coordinates change that a program has computed
    if (named || op == GRAPH_TEXTURE) {
        node = InputNodeRef(reader.nodes).v[immediate];
        value = node.fallback;
    }
    if (named) {
        if (node.primvar != reader.cornersName) {
            reader.corners = findPrimvar(reader.point.instance, reader.point.geometry, reader.point.primitive,
                                         reader.point.vertices, node.primvar);
            reader.cornersName = node.primvar;
        }
        vec2 st0 = transformSt(node, reader.corners.a.xy);
        reader.edges = vec4(transformSt(node, reader.corners.b.xy) - st0, transformSt(node, reader.corners.c.xy) - st0);
        vec4 primvar = interpolatePrimvar(reader.corners, reader.point.uv);
        if (reader.corners.found) value = primvar;
        st = reader.corners.found ? primvar.xy : node.uvFallback;
        area = reader.point.footprint * abs(reader.edges.x * reader.edges.w - reader.edges.y * reader.edges.z);
    }
    if ((reads && node.texture != NO_INDEX) || op == GRAPH_TEXTURE)
        value = sampleTextureNode(reader.scene, node, transformSt(node, st), area, reader.point.levelShare);
    if (reads || op == GRAPH_TEXTURE) return selectChannel(value, node.channel);
    if (op == GRAPH_POSITION) {
        vec3 p = surfaceAt(reader.point).position;
        return vec4(immediate == GRAPH_WORLD ? reader.point.instance.objectToWorld * vec4(p, 1.0) : p, 1.0);
    }
    if (op == GRAPH_TRANSFORM) return vec4(graphTransform(reader.point.instance, a.xyz, immediate), a.w);
    return vec4(graphDirection(reader.point, op, immediate, reader.edges), 0.0);
}

// Runs one step and keeps its value. What is no number becomes 0, and infinity a large one; but what is read for an input
// alone stays as it is: broken data are dropped, and told, where they reach the picture.
vec4 evaluateStep(inout GraphReader reader, GraphStep step_) {
    if (!sceneHas(SCENE_HAS_GRAPHS)) return graphRead(reader, GRAPH_READ, step_.immediate, vec4(0.0));
    uint op = step_.code & 0xffu, result = (step_.code >> 8) & 0xffu;
    vec4 a = vec4(0.0), b = vec4(0.0), c = vec4(0.0), value;
    if (op >= GRAPH_FIRST_WITH_OPERANDS) {
        a = graphOperand(reader, step_.operands & 0xffffu);
        b = graphOperand(reader, step_.operands >> 16);
        c = graphOperand(reader, step_.operand);
    }
    if (op < GRAPH_FIRST_PURE)
        value = graphRead(reader, op, step_.immediate, a);
    else
        value = graphValue(op, step_.immediate, a, b, c);
    if (op >= GRAPH_FIRST_PURE || result != GRAPH_NOWHERE)
        value = clamp(mix(value, vec4(0.0), isnan(value)), -1e18, 1e18);
    if (result != GRAPH_NOWHERE) graphRegisters[min(result, GRAPH_REGISTERS - 1u)] = value;
    return value;
}
#endif
