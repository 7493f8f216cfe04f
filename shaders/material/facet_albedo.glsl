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
