// The lobes of OpenPBR Surface 1.1 (Academy Software Foundation). docs/materials.md has the formulas.
#ifndef HIPR_MATERIAL_OPENPBR_GLSL
#define HIPR_MATERIAL_OPENPBR_GLSL
#include "material/inputs.glsl"
#include "material/facet_albedo.glsl"
#include "material/oren_nayar.glsl"
#include "shared/fuzz.h"

// Reflectance at normal incidence is the square of this.
float indexStep(float eta) { return abs(1.0 - eta) / (1.0 + eta); }

// The index of the interface below the coat over that of what is `around`, and its step: specification, "Dielectric base",
// "Coat", "Total internal reflection".
float interfaceIndex(MaterialInputs inputs, float around, float coat, out float step_) {
    float base = clamp(inputs.ior, 0.1, 10.0), coated = base / clamp(inputs.coatIor, 0.1, 10.0);
    float eta = mix(base / around, max(coated, 1.0 / coated), coat);
    step_ = min(indexStep(eta) * sqrt(max(inputs.specularWeight, 0.0)), INTERFACE_MOST);
    float signed_ = eta < 1.0 ? -step_ : step_;
    return (1.0 + signed_) / (1.0 - signed_);
}

// The metal's Fresnel term: A. Kutz, M. Hasan and P. Edmondson, "Novel aspects of the Adobe Standard Material", 2021. Tinted
// by `tint` at 82 degrees, where the cosine is 1/7.
vec3 edgeOf(vec3 f0, vec3 tint) {
    const float keep = 6.0 / 7.0, fifth = keep * keep * keep * keep * keep;
    return (1.0 - tint) * (f0 + (1.0 - f0) * fifth) * 7.0 / (fifth * keep);
}

void setOpenPbrBase(inout Surface s, MaterialInputs inputs, uint flags) {
    float metalness = clamp(inputs.metalness, 0.0, 1.0), transmission = clamp(inputs.transmissionWeight, 0.0, 1.0);
    float subsurface = clamp(inputs.subsurfaceWeight, 0.0, 1.0), weight = clamp(inputs.baseWeight, 0.0, 1.0);
    vec3 tint = clamp(inputs.specularColor, 0.0, 1.0);
    s.diffuse = clamp(inputs.baseColor, 0.0, 1.0);
    s.f0 = weight * s.diffuse;
    s.edge = edgeOf(s.f0, tint);
    s.metal = vec3(metalness * clamp(inputs.specularWeight, 0.0, 1.0));
    s.transmission = transmission;
    s.glass = (1.0 - metalness) * transmission;
    s.dielectric = s.inside ? vec3(s.glass) : (1.0 - metalness) * tint; // what scatters lies on the interface's outside alone
    s.glassTint = clamp(inputs.transmissionColor, 0.0, 1.0);
    s.film = clamp(inputs.filmWeight, 0.0, 1.0);
    s.filmIor = clamp(inputs.filmIor, 0.1, 10.0);
    s.filmThickness = max(inputs.filmThickness, 0.0);
    float opaque = (1.0 - metalness) * (1.0 - transmission);
    s.diffuseWeight = opaque * (1.0 - subsurface) * weight;
    s.diffuseRoughness = clamp(inputs.diffuseRoughness, 0.0, 1.0);
    s.subsurfaceColor = clamp(inputs.subsurfaceColor, 0.0, 1.0);
    s.subsurfaceRadius = inputs.subsurfaceRadius * clamp(inputs.subsurfaceRadiusScale, 0.01, 1.0);
    bool travels = (flags & MATERIAL_SUBSURFACE) != 0u && inputs.subsurfaceRadius > 0.0;
    s.subsurface = travels ? opaque * subsurface : 0.0;
    vec3 scattered = travels ? vec3(0.0) : opaque * subsurface * s.subsurfaceColor;
    float through = s.thinWalled ? 0.5 + 0.5 * clamp(inputs.subsurfaceAnisotropy, -1.0, 1.0) : 0.0;
    s.scatterUp = scattered * (1.0 - through);
    s.scatterDown = scattered * through;
}

void setOpenPbrLobes(inout Surface s, MaterialInputs inputs, uint flags) {
    s.thinWalled = (flags & MATERIAL_THIN_WALLED) != 0u;
    s.inside = !s.frontFacing && (flags & MATERIAL_REFRACTIVE) != 0u;
    float coat = clamp(inputs.coatWeight, 0.0, 1.0);
    s.coat = s.inside ? 0.0 : coat; // coat and fuzz are on the outside only
    s.fuzz = s.inside ? 0.0 : clamp(inputs.fuzzWeight, 0.0, 1.0);
    s.fuzzColor = clamp(inputs.fuzzColor, 0.0, 1.0);
    s.fuzzRoughness = clamp(inputs.fuzzRoughness, FUZZ_LEAST_ROUGHNESS, 1.0);
    s.coatEta = clamp(inputs.coatIor, 0.1, 10.0) / s.aroundIor;
    float coatRoughness = clamp(inputs.coatRoughness, 0.0, 1.0), coat2 = coatRoughness * coatRoughness;
    s.coatRoughness = coatRoughness;
    s.coatAnisotropy = clamp(inputs.coatAnisotropy, 0.0, 1.0);
    s.coatAlpha = stretchedAlpha(coatRoughness, inputs.coatAnisotropy);
    s.coatAbsorption = 0.5 * log(clamp(inputs.coatColor, 1e-4, 1.0));
    // A rough coat blurs what is below: specification, "Roughening".
    float rough = clamp(inputs.roughness, 0.0, 1.0), rough2 = rough * rough;
    s.roughness = mix(rough, sqrt(sqrt(min(1.0, rough2 * rough2 + 2.0 * coat2 * coat2))), coat);
    s.anisotropy = clamp(inputs.anisotropy, 0.0, 1.0);
    s.alpha = stretchedAlpha(s.roughness, s.anisotropy);
    float eta = interfaceIndex(inputs, s.aroundIor, coat, s.interfaceStep);
    if ((flags & MATERIAL_REFRACTIVE) != 0u) eta = usableIor(eta);
    s.eta = s.inside ? 1.0 / eta : eta;
    s.dense = s.eta < 1.0;
    setOpenPbrBase(s, inputs, flags);
    s.emission = max(inputs.emissionLuminance, 0.0) * max(inputs.emissionColor, 0.0);
}

// The cosine of a direction refracted into the coat.
float cosineInCoat(Surface s, float cosine) {
    return sqrt(max(1.0 - (1.0 - cosine * cosine) / (s.coatEta * s.coatEta), 1e-4));
}

// How much darker the base is under the coat, by light going back and forth between the two: specification, "Darkening".
vec3 coatDarkening(Surface s, float cosine, float weight) {
    vec3 scattered = s.diffuseWeight * s.diffuse + s.scatterUp + s.scatterDown + s.glass * s.glassTint;
    scattered += s.subsurface * s.subsurfaceColor;
    float fresnel = s.interfaceStep * s.interfaceStep;
    vec3 base = s.metal * s.f0 + s.dielectric * fresnel + (1.0 - fresnel) * scattered;
    InterfaceCell smooth_ = interfaceCell(false, indexStep(s.coatEta), 0.0);
    float diffuseBack = 1.0 - (1.0 - meanInterfaceAlbedo(s.openPbrTable, smooth_).x) / (s.coatEta * s.coatEta);
    float rough = mix(mix(1.0, s.roughness, fresnel), s.roughness, s.metal.x);
    float back = clamp(mix(dielectricFresnel(cosine, s.coatEta), diffuseBack, rough), 0.0, 0.99);
    return mix(vec3(1.0), (1.0 - back) / (1.0 - min(base, 1.0) * back), weight);
}

// Light of several microfacets. C. Kulla and A. Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017
// course: what one bounce loses comes back evenly. Metal colours it; an interface transmits as much of it as reciprocity
// allows, and reflects the rest. `kept`: what the interface's facets reflect and transmit at once.
void setOpenPbrMulti(inout Surface s, vec2 single, vec3 kept, vec2 mean) {
    float whole = meanFacetAlbedo(s), missing = 1.0 - (single.x + single.y);
    vec3 average = clamp(s.f0 + (1.0 - s.f0) / 21.0 - s.edge / 126.0, 0.0, 1.0);
    s.multiMetal = s.metal * average * average * whole / (1.0 - average * (1.0 - whole));
    s.multiMetal *= missing / max(1.0 - whole, 1e-4);
    float here = max(1.0 - mean.y, 1e-5), there = max(1.0 - meanBaseAlbedo(s, !s.dense).y, 1e-5);
    float transmitted = s.thinWalled ? 0.5 : min(1.0, there * s.eta * s.eta / here);
    vec3 lost = s.glass * (s.thinWalled ? vec3(missing / max(1.0 - whole, 1e-4)) : 1.0 - kept);
    s.multiUp = lost * (1.0 - transmitted) / (s.thinWalled ? 1.0 : here);
    s.multiDown = lost * transmitted / (s.thinWalled ? 1.0 : there);
}

// What depends on the viewer: albedos of the lobes seen from `o` in their frame, `coatO` in that of the coat, and how often
// each is sampled.
void setOpenPbrViewer(inout Surface s, float darkening, vec3 o, vec3 coatO) {
    float cosine = o.z, coatCosine = coatO.z;
    vec2 single = facetAlbedo(s, o), seen = baseAlbedo(s, s.dense, o), mean = meanBaseAlbedo(s, s.dense);
    s.interfaceOut = vec3(sheetReflectance(s, seen.x));
    vec3 kept = vec3(seen.y);
    if (s.film > 0.0) {
        vec3 filmReflected, filmKept;
        filmAlbedo(s, o, filmReflected, filmKept);
        s.interfaceOut = clamp(s.interfaceOut + filmReflected, 0.0, 1.0);
        kept = min(kept + filmKept, 1.0);
    }
    s.interfaceMean = vec3(sheetReflectance(s, mean.x));
    if (s.inside) s.interfaceOut = s.interfaceMean = vec3(0.0);
    s.orenNayarOut = orenNayarAlbedo(cosine, s.diffuseRoughness);
    setOpenPbrMulti(s, single, kept, mean);

    Interface coat = Interface(false, indexStep(s.coatEta), s.coatRoughness, s.coatAnisotropy);
    float coatAlbedo = interfaceAlbedo(s, coat, coatO).x;
    s.coatOut = s.coat * coatAlbedo;
    vec3 absorbed = exp(s.coatAbsorption / cosineInCoat(s, coatCosine));
    s.coatThrough = (1.0 - coatAlbedo) * absorbed;
    s.below = coatDarkening(s, coatCosine, s.coat * darkening);
    s.fuzzOut = s.fuzz * fuzzAlbedo(s.openPbrTable, cosine, s.fuzzRoughness);
    float base = 1.0 - s.fuzzOut;
    s.emission *= base * mix(vec3(1.0), absorbed, s.coat);

    vec3 multi = s.multiMetal * (1.0 - (single.x + single.y)); // roughly
    vec3 metal = s.metal * (s.f0 * single.x + single.y), reflected = s.dielectric * s.interfaceOut;
    vec3 scattered = s.diffuse * s.diffuseWeight + s.scatterUp, under = s.subsurface * s.subsurfaceColor;
    vec3 below = base * s.below * mix(vec3(1.0), s.coatThrough * exp(s.coatAbsorption), s.coat);
    s.albedo = s.fuzzOut * s.fuzzColor + base * s.coatOut;
    float entered = 1.0 - luminance(s.interfaceOut), lost = s.glass * (1.0 - luminance(kept));
    s.albedo += below * (metal + reflected + entered * (scattered + s.scatterDown + under + s.glass * s.glassTint));
    float weight = luminance(below);
    s.lobeChance = vec4(base * s.coatOut, weight * (luminance(metal) + luminance(reflected) * (1.0 - s.transmission)),
                        weight * (luminance(scattered) * entered + luminance(multi) + lost), weight * s.glass);
    s.moreChance = vec3(weight * (luminance(s.scatterDown) * entered + lost),
                        s.fuzzOut * max(luminance(s.fuzzColor), 0.05), weight * luminance(under) * entered);
    normalizeChances(s);
}

// The boundary of a subsurface medium seen from inside: lets light out evenly, less of it where the outside would
// reflect it, as on the way in.
void setSubsurfaceExit(inout Surface s) {
    s.emission = s.metal = s.dielectric = s.scatterUp = s.interfaceOut = vec3(0.0);
    s.multiMetal = s.multiUp = s.multiDown = vec3(0.0);
    s.glass = s.diffuseWeight = s.subsurface = s.coat = s.fuzz = s.coatOut = s.fuzzOut = 0.0;
    s.scatterDown = s.below = vec3(1.0);
    s.inside = s.dense = true;
    s.interfaceMean = vec3(meanBaseAlbedo(s, false).x);
    s.lobeChance = vec4(0.0);
    s.moreChance = vec3(1.0, 0.0, 0.0);
}
#endif
