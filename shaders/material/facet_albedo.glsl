// Directional albedos of a surface's facets, from the tables of even lobes or of stretched ones; all directions are in the
// frame of the lobe. Kernels for scenes without OpenPBR know even ones alone.
#ifndef HIPR_MATERIAL_FACET_ALBEDO_GLSL
#define HIPR_MATERIAL_FACET_ALBEDO_GLSL
#include "material/lobes.glsl"
#include "material/openpbr_albedo.glsl"
#include "material/stretched_albedo.glsl"

// An interface of facets.
struct Interface {
    bool dense;      // the index is higher on the side it is seen from
    float indexStep;
    float roughness, anisotropy;
};

StretchedPlace stretchedPlace(Interface facets) {
    return stretchedPlace(stretchedPlane(facets.dense, facets.indexStep), facets.anisotropy, facets.roughness);
}

vec2 interfaceAlbedo(Surface s, Interface facets, vec3 w) {
    if (facets.anisotropy > 0.0) return stretchedAlbedo(s.stretchedTable, stretchedPlace(facets), w);
    return interfaceAlbedo(s.openPbrTable, interfaceCell(facets.dense, facets.indexStep, facets.roughness), abs(w.z));
}

// The interface of an OpenPBR base, seen from where its index is higher or from the other side.
Interface baseInterface(Surface s, bool dense) {
    return Interface(dense, s.interfaceStep, s.roughness, s.anisotropy);
}

vec2 baseAlbedo(Surface s, bool dense, vec3 w) { return interfaceAlbedo(s, baseInterface(s, dense), w); }

vec2 meanBaseAlbedo(Surface s, bool dense) {
    if (s.anisotropy > 0.0) return meanStretchedAlbedo(s.stretchedTable, stretchedPlace(baseInterface(s, dense)));
    return meanInterfaceAlbedo(s.openPbrTable, interfaceCell(dense, s.interfaceStep, s.roughness));
}

// Visible normals of filmed facets: points of Gauss and Legendre's quadrature outwards, even steps around.
const uint FILM_RINGS = 4u;
const float FILM_AT[FILM_RINGS] = float[](0.0694318442, 0.3300094782, 0.6699905218, 0.9305681558);
const float FILM_SHARE[FILM_RINGS] = float[](0.1739274226, 0.3260725774, 0.3260725774, 0.1739274226);

// How much a film adds to what the base's facets reflect of light from `o`, and to that plus what they transmit.
void filmAlbedo(Surface s, vec3 o, out vec3 reflected, out vec3 kept) {
    float lambdaO = ggxLambda(o, s.alpha);
    bool even = s.anisotropy == 0.0; // half a turn will do
    if (even) o = vec3(length(o.xy), 0.0, o.z);
    uint turns = even ? 4u : 8u;
    reflected = kept = vec3(0.0);
    for (uint k = 0u; k < FILM_RINGS * turns; ++k) {
        uint ring = k % FILM_RINGS;
        vec3 h = sampleVisibleNormal(o, s.alpha, vec2((float(k / FILM_RINGS) + 0.5) * 0.125, FILM_AT[ring]));
        float cosine = clamp(dot(o, h), 0.0, 1.0), back = reflectedPart(o, h, s.alpha, lambdaO);
        vec3 more = interfaceFresnel(s, cosine) - sheetReflectance(s, dielectricFresnel(cosine, s.eta));
        more *= FILM_SHARE[ring] / float(turns);
        reflected += more * back;
        if (!s.thinWalled) kept += more * (back - refractedPart(o, h, s.alpha, s.eta)); // sheets do not refract
    }
}

// As specularAlbedo(): stretching is taken to take as much from Schlick's term.
vec2 facetAlbedo(Surface s, vec3 w) {
    vec2 albedo = specularAlbedo(s.albedoTable, abs(w.z), s.roughness);
    if (sceneHas(SCENE_HAS_OPENPBR) && s.anisotropy > 0.0) {
        StretchedPlace mirror = stretchedPlace(STRETCHED_MIRROR, s.anisotropy, s.roughness);
        albedo *= stretchedAlbedo(s.stretchedTable, mirror, w).x / max(albedo.x + albedo.y, 1e-4);
    }
    return albedo;
}

// The part that facets reflect if they are perfect mirrors, averaged over the hemisphere.
float meanFacetAlbedo(Surface s) {
    if (s.anisotropy > 0.0)
        return meanStretchedAlbedo(s.stretchedTable, stretchedPlace(STRETCHED_MIRROR, s.anisotropy, s.roughness)).x;
    vec2 mean = meanSpecularAlbedo(s.albedoTable, s.roughness);
    return mean.x + mean.y;
}
#endif
