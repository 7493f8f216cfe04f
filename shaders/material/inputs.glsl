// The inputs of a material at a hit.
#ifndef HIPR_MATERIAL_INPUTS_GLSL
#define HIPR_MATERIAL_INPUTS_GLSL
#extension GL_EXT_control_flow_attributes : require
#include "material/graph.glsl"

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
    float subsurfaceRadius;
    vec3 subsurfaceRadiusScale;
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
    vec3 worldNormal;  // where a program makes one, else 0; so are those below
    vec3 coatNormal;
    vec3 specularTangent;
    vec3 coatTangent;
};

bool isOpenPbr(uint materialFlags) { return sceneHas(SCENE_HAS_OPENPBR) && (materialFlags & MATERIAL_OPENPBR) != 0u; }

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
    inputs.worldNormal = inputs.coatNormal = inputs.specularTangent = inputs.coatTangent = vec3(0.0);
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
    inputs.subsurfaceRadius = constants.v[INPUT_SUBSURFACE_RADIUS].x;
    inputs.subsurfaceRadiusScale = constants.v[INPUT_SUBSURFACE_RADIUS_SCALE].rgb;
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
    case INPUT_SUBSURFACE_RADIUS: inputs.subsurfaceRadius = value.x; break;
    case INPUT_SUBSURFACE_RADIUS_SCALE: inputs.subsurfaceRadiusScale = value.rgb; break;
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
    case INPUT_WORLD_NORMAL: if (sceneHas(SCENE_HAS_GRAPHS)) inputs.worldNormal = value.xyz; break;
    case INPUT_COAT_NORMAL: if (sceneHas(SCENE_HAS_DIRECTIONS)) inputs.coatNormal = value.xyz; break;
    case INPUT_SPECULAR_TANGENT: if (sceneHas(SCENE_HAS_DIRECTIONS)) inputs.specularTangent = value.xyz; break;
    case INPUT_COAT_TANGENT: if (sceneHas(SCENE_HAS_DIRECTIONS)) inputs.coatTangent = value.xyz; break;
    }
}

// The inputs of a material, after the first `count` steps of its program. One loop with one texture look-up inside keeps
// the kernel small: see docs/architecture.md.
MaterialInputs evaluateInputs(SceneRecord scene, ShadingPoint point, MaterialRecord material, uint count) {
    MaterialInputs inputs = constantInputs(material.constants, isOpenPbr(material.flags));
    GraphReader reader = graphReader(scene, point, material);
    [[dont_unroll]] for (uint k = 0u; k < count; ++k) {
        GraphStep step_ = GraphStepRef(material.steps).v[k];
        reader.point.footprint = k < material.presenceSteps ? 0.0 : point.footprint; // shadow rays have none
        vec4 value = evaluateStep(reader, step_);
        uint target = step_.code >> 16;
        setInput(inputs, target, value);
        if (target == INPUT_NORMAL) inputs.stEdges = reader.edges;
        if (sceneHas(SCENE_HAS_OPENPBR) && target == INPUT_TANGENT) inputs.tangentEdges = reader.edges;
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
