// The inputs of a UsdPreviewSurface at a hit.
#ifndef HIPR_MATERIAL_INPUTS_GLSL
#define HIPR_MATERIAL_INPUTS_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "material/primvar.glsl"
#include "material/texture.glsl"

// What a material reads at a hit: the triangle it is on, and where on it.
struct ShadingPoint {
    InstanceRecord instance;
    GeometryRecord geometry;
    uint primitive;
    uvec3 vertices;
    vec2 uv; // barycentric weights of vertices 1 and 2
};

struct MaterialInputs {
    vec3 diffuseColor;
    vec3 emissiveColor;
    vec3 specularColor;
    float metallic;
    float roughness;
    float clearcoat;
    float clearcoatRoughness;
    float opacity;
    float opacityThreshold;
    float ior;
    vec3 normal;     // tangent space
    vec4 stEdges;    // the normal map's texture coordinates: differences of corners 1 and 2 to corner 0; 0: no normal map
};

ShadingPoint shadingPoint(SceneRecord scene, Hit hit) {
    ShadingPoint point;
    point.instance = InstanceRef(scene.instances).v[hit.instance];
    point.geometry = GeometryRef(scene.geometries).v[point.instance.geometry];
    point.primitive = hit.primitive;
    point.vertices = Uvec3Ref(point.geometry.triangles).v[hit.primitive];
    point.uv = vec2(hit.u, hit.v);
    return point;
}

// The MaterialRecord of a hit's slot.
uint materialIndex(SceneRecord scene, ShadingPoint point) {
    if (point.instance.materialCount == 0u) return 0u;
    uint slot = 0u;
    if (point.geometry.triangleSlot != 0ul) slot = uint(Uint16Ref(point.geometry.triangleSlot).v[point.primitive]);
    slot = min(slot, point.instance.materialCount - 1u);
    return UintRef(scene.materialIndices).v[point.instance.firstMaterial + slot];
}

vec4 selectChannel(vec4 value, uint channel) {
    if (channel == 0u) return value.xxxx;
    if (channel == 1u) return value.yyyy;
    if (channel == 2u) return value.zzzz;
    if (channel == 3u) return value.wwww;
    return value;
}

vec2 transformSt(InputNode node, vec2 st) { return node.uvAxisU * st.x + node.uvAxisV * st.y + node.uvOffset; }

// A UsdUVTexture: scale and bias apply to what the file holds, not to the fallback.
vec4 sampleTextureNode(SceneRecord scene, InputNode node, vec2 st) {
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
    return sampleTexture(texture, st) * node.scale + node.bias;
}

// The constants of all inputs: straight loads of just the channels in use, no loop.
MaterialInputs constantInputs(SceneRecord scene, uint material) {
    MaterialRef records = MaterialRef(scene.materials);
    MaterialInputs inputs;
    inputs.diffuseColor = records.v[material].constants[INPUT_DIFFUSE_COLOR].rgb;
    inputs.emissiveColor = records.v[material].constants[INPUT_EMISSIVE_COLOR].rgb;
    inputs.specularColor = records.v[material].constants[INPUT_SPECULAR_COLOR].rgb;
    inputs.metallic = records.v[material].constants[INPUT_METALLIC].x;
    inputs.roughness = records.v[material].constants[INPUT_ROUGHNESS].x;
    inputs.clearcoat = records.v[material].constants[INPUT_CLEARCOAT].x;
    inputs.clearcoatRoughness = records.v[material].constants[INPUT_CLEARCOAT_ROUGHNESS].x;
    inputs.opacity = records.v[material].constants[INPUT_OPACITY].x;
    inputs.opacityThreshold = records.v[material].constants[INPUT_OPACITY_THRESHOLD].x;
    inputs.ior = records.v[material].constants[INPUT_IOR].x;
    inputs.normal = records.v[material].constants[INPUT_NORMAL].xyz;
    inputs.stEdges = vec4(0.0);
    return inputs;
}

// Evaluates inputs first..last (INPUT_*) of a material; the others keep their constants. One loop with one texture
// look-up inside keeps the kernel small: see docs/architecture.md.
MaterialInputs evaluateInputs(SceneRecord scene, ShadingPoint point, uint material, uint first, uint last) {
    MaterialInputs inputs = constantInputs(scene, material);
    MaterialRef records = MaterialRef(scene.materials);
    if ((records.v[material].flags & MATERIAL_HAS_NODES) == 0u) return inputs;
    InputNodeRef nodes = InputNodeRef(records.v[material].inputNodes);
    PrimvarCorners corners;
    uint cornersName = NO_INDEX;
    [[dont_unroll]] for (uint i = first; i <= last; ++i) {
        uint nodeIndex = records.v[material].nodes[i];
        if (nodeIndex == NO_INDEX) continue;
        InputNode node = nodes.v[nodeIndex];
        if (node.primvar != cornersName) {
            corners = findPrimvar(point.instance, point.geometry, point.primitive, point.vertices, node.primvar);
            cornersName = node.primvar;
        }
        vec4 primvar = interpolatePrimvar(corners, point.uv);
        vec4 value;
        if (node.texture != NO_INDEX) {
            value = sampleTextureNode(scene, node, transformSt(node, corners.found ? primvar.xy : node.uvFallback));
            if (i == INPUT_NORMAL) {
                vec2 st0 = transformSt(node, corners.a.xy);
                inputs.stEdges = vec4(transformSt(node, corners.b.xy) - st0, transformSt(node, corners.c.xy) - st0);
            }
        } else {
            value = corners.found ? primvar : node.fallback;
        }
        value = selectChannel(value, node.channel);
        switch (i) {
        case INPUT_DIFFUSE_COLOR: inputs.diffuseColor = value.rgb; break;
        case INPUT_EMISSIVE_COLOR: inputs.emissiveColor = value.rgb; break;
        case INPUT_SPECULAR_COLOR: inputs.specularColor = value.rgb; break;
        case INPUT_METALLIC: inputs.metallic = value.x; break;
        case INPUT_ROUGHNESS: inputs.roughness = value.x; break;
        case INPUT_CLEARCOAT: inputs.clearcoat = value.x; break;
        case INPUT_CLEARCOAT_ROUGHNESS: inputs.clearcoatRoughness = value.x; break;
        case INPUT_OPACITY: inputs.opacity = value.x; break;
        case INPUT_OPACITY_THRESHOLD: inputs.opacityThreshold = value.x; break;
        case INPUT_IOR: inputs.ior = value.x; break;
        case INPUT_NORMAL: inputs.normal = value.xyz; break;
        }
    }
    return inputs;
}

// The part of light that a surface stops, from its opacity inputs: UsdPreviewSurface Specification 2.6, opacityThreshold.
float presenceOf(uint materialFlags, MaterialInputs inputs) {
    if ((materialFlags & MATERIAL_PRESENCE) == 0u) return 1.0;
    float opacity = clamp(inputs.opacity, 0.0, 1.0);
    if (inputs.opacityThreshold > 0.0) return opacity >= inputs.opacityThreshold ? 1.0 : 0.0;
    return opacity;
}
#endif
