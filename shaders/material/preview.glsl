// The lobes of a UsdPreviewSurface (UsdPreviewSurface Specification 2.6).
#ifndef HIPR_MATERIAL_PREVIEW_GLSL
#define HIPR_MATERIAL_PREVIEW_GLSL
#include "material/inputs.glsl"
#include "material/lobes.glsl"

const float COAT_F0 = 0.04; // index of refraction 1.5

void setPreviewLobes(inout Surface s, MaterialInputs inputs, uint flags) {
    float metallic = clamp(inputs.metalness, 0.0, 1.0);
    vec3 color = clamp(inputs.baseColor, 0.0, 1.0);
    float ior = usableIor(inputs.ior);
    float index = clamp(inputs.ior, 0.0, 100.0); // 0, a way to ask for a full mirror, included
    float normalIncidence = (1.0 - index) / (1.0 + index);
    bool specularWorkflow = (flags & MATERIAL_SPECULAR_WORKFLOW) != 0u;
    bool refractive = (flags & MATERIAL_REFRACTIVE) != 0u;
    s.emission = max(inputs.emissionColor, 0.0);
    s.f0 = specularWorkflow ? clamp(inputs.specularColor, 0.0, 1.0)
                            : mix(vec3(normalIncidence * normalIncidence), color, metallic);
    s.glass = refractive ? 1.0 - clamp(inputs.opacity, 0.0, 1.0) : 0.0;
    s.transmission = s.glass;
    s.metal = vec3(1.0 - s.glass);
    s.edge = vec3(0.0);
    s.dielectric = vec3(s.glass);
    s.glassTint = vec3(1.0);
    s.film = s.filmThickness = 0.0;
    s.filmIor = 1.0;
    s.eta = s.frontFacing ? ior : 1.0 / ior;
    s.roughness = clamp(inputs.roughness, 0.0, 1.0);
    s.anisotropy = s.coatAnisotropy = 0.0;
    s.alpha = vec2(max(s.roughness * s.roughness, MIN_ALPHA));
    s.diffuse = specularWorkflow ? color : color * (1.0 - metallic);
    s.diffuseWeight = 1.0 - s.glass;
    s.diffuseRoughness = 0.0;
    s.scatterUp = s.scatterDown = s.subsurfaceColor = vec3(0.0);
    s.subsurface = 0.0;
    s.coat = refractive && !s.frontFacing ? 0.0 : clamp(inputs.coatWeight, 0.0, 1.0); // a coat is on the outside only
    s.coatEta = 1.5;
    s.coatRoughness = clamp(inputs.coatRoughness, 0.0, 1.0);
    s.coatAlpha = vec2(max(s.coatRoughness * s.coatRoughness, MIN_ALPHA));
    s.fuzz = 0.0;
    s.fuzzColor = vec3(0.0);
    s.fuzzRoughness = 1.0;
    s.thinWalled = false;
}

// What depends on the viewer: albedos of the lobes seen from `cosine`, and how often each is sampled.
void setPreviewViewer(inout Surface s, float cosine) {
    vec2 towards = specularAlbedo(s.albedoTable, cosine, s.roughness);
    vec2 mean = meanSpecularAlbedo(s.albedoTable, s.roughness);
    vec2 coat = specularAlbedo(s.albedoTable, cosine, s.coatRoughness);
    s.interfaceOut = s.f0 * towards.x + towards.y;
    s.interfaceMean = s.f0 * mean.x + mean.y;
    s.coatOut = s.coat * (COAT_F0 * coat.x + coat.y);
    s.coatAbsorption = s.coatThrough = s.multiMetal = s.multiUp = s.multiDown = vec3(0.0);
    s.below = vec3(1.0);
    s.fuzzOut = s.orenNayarOut = s.interfaceStep = 0.0;
    s.inside = false;
    vec3 diffuse = s.diffuse * (1.0 - s.interfaceOut);
    float below = 1.0 - s.coatOut;
    s.albedo = s.coatOut + below * mix(s.interfaceOut + diffuse, vec3(1.0), s.glass);
    s.lobeChance = vec4(s.coatOut, below * (1.0 - s.glass) * luminance(s.interfaceOut),
                        below * (1.0 - s.glass) * luminance(diffuse), below * s.glass);
    s.moreChance = vec3(0.0);
    normalizeChances(s);
}
#endif
