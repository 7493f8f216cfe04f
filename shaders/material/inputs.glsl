// The inputs of a material at a hit.
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

// By OpenPBR's names; a UsdPreviewSurface has those above baseWeight.
struct MaterialInputs {
    vec3 baseColor;
    vec3 emissionColor;
    vec3 specularColor;
    float metalness;
    float roughness;
    float coatWeight;
    float coatRoughness;
    float opacity;
    float opacityThreshold;
    float ior;
    vec3 normal;     // tangent space
    vec4 stEdges;    // the normal map's texture coordinates: differences of corners 1 and 2 to corner 0; 0: no normal map

    float baseWeight;
    float diffuseRoughness;
    float specularWeight;
    float anisotropy;
    float transmissionWeight;
    vec3 transmissionColor;
    float subsurfaceWeight;
    vec3 subsurfaceColor;
    float subsurfaceAnisotropy;
    float fuzzWeight;
    vec3 fuzzColor;
    float fuzzRoughness;
    vec3 coatColor;
    float coatAnisotropy;
    float coatIor;
    float coatDarkening;
    float emissionLuminance;
    float filmWeight;
    float filmThickness; // micrometres
    float filmIor;
    vec4 tangentEdges; // as stEdges, of the coordinates that stretched highlights follow
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

// The constants of a row: straight loads of just the channels in use, no loop.
MaterialInputs constantInputs(uint64_t row, bool openPbr) {
    Vec4Ref constants = Vec4Ref(row);
    MaterialInputs inputs;
    inputs.baseColor = constants.v[INPUT_BASE_COLOR].rgb;
    inputs.emissionColor = constants.v[INPUT_EMISSION_COLOR].rgb;
    inputs.specularColor = constants.v[INPUT_SPECULAR_COLOR].rgb;
    inputs.metalness = constants.v[INPUT_BASE_METALNESS].x;
    inputs.roughness = constants.v[INPUT_SPECULAR_ROUGHNESS].x;
    inputs.coatWeight = constants.v[INPUT_COAT_WEIGHT].x;
    inputs.coatRoughness = constants.v[INPUT_COAT_ROUGHNESS].x;
    inputs.opacity = constants.v[INPUT_OPACITY].x;
    inputs.opacityThreshold = constants.v[INPUT_OPACITY_THRESHOLD].x;
    inputs.ior = constants.v[INPUT_SPECULAR_IOR].x;
    inputs.normal = constants.v[INPUT_NORMAL].xyz;
    inputs.stEdges = inputs.tangentEdges = vec4(0.0);
    if (!openPbr) return inputs;
    inputs.baseWeight = constants.v[INPUT_BASE_WEIGHT].x;
    inputs.diffuseRoughness = constants.v[INPUT_BASE_DIFFUSE_ROUGHNESS].x;
    inputs.specularWeight = constants.v[INPUT_SPECULAR_WEIGHT].x;
    inputs.anisotropy = constants.v[INPUT_SPECULAR_ANISOTROPY].x;
    inputs.transmissionWeight = constants.v[INPUT_TRANSMISSION_WEIGHT].x;
    inputs.transmissionColor = constants.v[INPUT_TRANSMISSION_COLOR].rgb;
    inputs.subsurfaceWeight = constants.v[INPUT_SUBSURFACE_WEIGHT].x;
    inputs.subsurfaceColor = constants.v[INPUT_SUBSURFACE_COLOR].rgb;
    inputs.subsurfaceAnisotropy = constants.v[INPUT_SUBSURFACE_ANISOTROPY].x;
    inputs.fuzzWeight = constants.v[INPUT_FUZZ_WEIGHT].x;
    inputs.fuzzColor = constants.v[INPUT_FUZZ_COLOR].rgb;
    inputs.fuzzRoughness = constants.v[INPUT_FUZZ_ROUGHNESS].x;
    inputs.coatColor = constants.v[INPUT_COAT_COLOR].rgb;
    inputs.coatAnisotropy = constants.v[INPUT_COAT_ANISOTROPY].x;
    inputs.coatIor = constants.v[INPUT_COAT_IOR].x;
    inputs.coatDarkening = constants.v[INPUT_COAT_DARKENING].x;
    inputs.emissionLuminance = constants.v[INPUT_EMISSION_LUMINANCE].x;
    inputs.filmWeight = constants.v[INPUT_THIN_FILM_WEIGHT].x;
    inputs.filmThickness = constants.v[INPUT_THIN_FILM_THICKNESS].x;
    inputs.filmIor = constants.v[INPUT_THIN_FILM_IOR].x;
    return inputs;
}

void setInput(inout MaterialInputs inputs, uint target, vec4 value) {
    switch (target) {
    case INPUT_BASE_COLOR: inputs.baseColor = value.rgb; break;
    case INPUT_EMISSION_COLOR: inputs.emissionColor = value.rgb; break;
    case INPUT_SPECULAR_COLOR: inputs.specularColor = value.rgb; break;
    case INPUT_BASE_METALNESS: inputs.metalness = value.x; break;
    case INPUT_SPECULAR_ROUGHNESS: inputs.roughness = value.x; break;
    case INPUT_COAT_WEIGHT: inputs.coatWeight = value.x; break;
    case INPUT_COAT_ROUGHNESS: inputs.coatRoughness = value.x; break;
    case INPUT_OPACITY: inputs.opacity = value.x; break;
    case INPUT_OPACITY_THRESHOLD: inputs.opacityThreshold = value.x; break;
    case INPUT_SPECULAR_IOR: inputs.ior = value.x; break;
    case INPUT_NORMAL: inputs.normal = value.xyz; break;
    case INPUT_BASE_WEIGHT: inputs.baseWeight = value.x; break;
    case INPUT_BASE_DIFFUSE_ROUGHNESS: inputs.diffuseRoughness = value.x; break;
    case INPUT_SPECULAR_WEIGHT: inputs.specularWeight = value.x; break;
    case INPUT_SPECULAR_ANISOTROPY: inputs.anisotropy = value.x; break;
    case INPUT_TRANSMISSION_WEIGHT: inputs.transmissionWeight = value.x; break;
    case INPUT_TRANSMISSION_COLOR: inputs.transmissionColor = value.rgb; break;
    case INPUT_SUBSURFACE_WEIGHT: inputs.subsurfaceWeight = value.x; break;
    case INPUT_SUBSURFACE_COLOR: inputs.subsurfaceColor = value.rgb; break;
    case INPUT_SUBSURFACE_ANISOTROPY: inputs.subsurfaceAnisotropy = value.x; break;
    case INPUT_FUZZ_WEIGHT: inputs.fuzzWeight = value.x; break;
    case INPUT_FUZZ_COLOR: inputs.fuzzColor = value.rgb; break;
    case INPUT_FUZZ_ROUGHNESS: inputs.fuzzRoughness = value.x; break;
    case INPUT_COAT_COLOR: inputs.coatColor = value.rgb; break;
    case INPUT_COAT_ANISOTROPY: inputs.coatAnisotropy = value.x; break;
    case INPUT_COAT_IOR: inputs.coatIor = value.x; break;
    case INPUT_COAT_DARKENING: inputs.coatDarkening = value.x; break;
    case INPUT_EMISSION_LUMINANCE: inputs.emissionLuminance = value.x; break;
    case INPUT_THIN_FILM_WEIGHT: inputs.filmWeight = value.x; break;
    case INPUT_THIN_FILM_THICKNESS: inputs.filmThickness = value.x; break;
    case INPUT_THIN_FILM_IOR: inputs.filmIor = value.x; break;
    }
}

// The inputs of a material; of those that nodes feed, first..last (INPUT_*) are evaluated and the others keep their
// constants. One loop with one texture look-up inside keeps the kernel small: see docs/architecture.md.
MaterialInputs evaluateInputs(SceneRecord scene, ShadingPoint point, MaterialRecord material, uint first, uint last) {
    MaterialInputs inputs = constantInputs(material.constants, (material.flags & MATERIAL_OPENPBR) != 0u);
    InputNodeRef nodes = InputNodeRef(material.nodes);
    PrimvarCorners corners;
    uint cornersName = NO_INDEX;
    [[dont_unroll]] for (uint k = 0u; k < material.nodeCount; ++k) {
        InputNode node = nodes.v[k];
        if (node.target < first || node.target > last) continue;
        if (node.primvar != cornersName) {
            corners = findPrimvar(point.instance, point.geometry, point.primitive, point.vertices, node.primvar);
            cornersName = node.primvar;
        }
        vec2 st0 = transformSt(node, corners.a.xy);
        vec4 edges = vec4(transformSt(node, corners.b.xy) - st0, transformSt(node, corners.c.xy) - st0);
        if (node.target == INPUT_NORMAL && node.texture != NO_INDEX) inputs.stEdges = edges;
        if (node.target == INPUT_TANGENT) inputs.tangentEdges = edges;
        vec4 primvar = interpolatePrimvar(corners, point.uv);
        vec4 value = corners.found ? primvar : node.fallback;
        if (node.texture != NO_INDEX)
            value = sampleTextureNode(scene, node, transformSt(node, corners.found ? primvar.xy : node.uvFallback));
        setInput(inputs, node.target, selectChannel(value, node.channel));
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
