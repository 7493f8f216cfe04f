// The parameters of a surface's BSDF, whatever material model they come from; bsdf.glsl tells what they mean.
#ifndef HIPR_MATERIAL_LOBES_GLSL
#define HIPR_MATERIAL_LOBES_GLSL
#include "material/microfacet.glsl"
#include "material/thin_film.glsl"

struct Surface {
    vec3 position;
    vec3 ng;            // geometric normal on the viewer's side, unit length
    vec3 ns;            // shading normal on the viewer's side, unit length
    float restless;     // rays that begin lower over the surface may meet it again, see restlessHeight()
    vec3 tangent;       // x axis of the lobes, perpendicular to ns
    vec3 coatNormal;    // as ns and tangent, of the coat: theirs but where the material says otherwise
    vec3 coatTangent;
    vec3 emission;      // radiance
    float opacity;      // part of light the surface stops; the rest goes straight on
    vec3 albedo;        // colour of all scattered light, for the albedo AOV
    bool frontFacing;
    bool openPbr;       // how layers share light: OpenPBR's way, else UsdPreviewSurface's
    bool thinWalled;    // a sheet: what is transmitted is not refracted
    uint material;      // its MaterialRecord
    uint around;        // the MaterialRecord of what the object is in, NO_INDEX: of nothing
    float aroundIor;    // and its index of refraction
    bool hidden;        // it is in something of a higher priority

    vec3 metal;         // weight of the reflection with Schlick's Fresnel term from f0 to 1, less edge * c * (1 - c)^6
    vec3 f0;
    vec3 edge;
    vec3 dielectric;    // weight of the reflection of the interface with index `eta`
    float transmission; // OpenPBR: the part of the interface that has glass below
    float glass;        // weight of transmission through that interface, 0 for opaque materials
    vec3 glassTint;
    float eta;          // index of refraction beyond the surface over that on the viewer's side
    float film;         // weight of a thin film on metal and interface
    float filmIor;
    float filmThickness; // micrometres
    float roughness;
    float anisotropy;
    vec2 alpha;         // GGX slope parameters along tangent and bitangent
    vec3 diffuse;       // colour of the diffuse lobe below the interface
    float diffuseWeight;
    float diffuseRoughness; // of Oren and Nayar, 0..1
    vec3 scatterUp;     // further light scattered evenly below the interface, upwards and
    vec3 scatterDown;   // through the surface
    float subsurface;   // weight of light that enters the medium below
    vec3 subsurfaceColor;
    vec3 subsurfaceRadius; // how far light goes in that medium
    float coat;         // weight of the clear coat
    float coatEta;
    float coatRoughness;
    float coatAnisotropy;
    vec2 coatAlpha;
    float fuzz;         // weight of the fuzz
    vec3 fuzzColor;
    float fuzzRoughness;

    // What depends on the viewer, too.
    uint64_t albedoTable, openPbrTable, stretchedTable;
    float interfaceStep; // |(1 - index) / (1 + index)| of the interface
    bool inside;         // the viewer is inside the object
    bool dense;          // the index is higher on the viewer's side
    vec3 interfaceOut;  // directional albedo of what lies on the diffuse lobe, towards the viewer
    vec3 interfaceMean; // its mean over all directions
    vec3 multiMetal;    // light reflected by several microfacets: by metal,
    vec3 multiUp;       // by the interface,
    vec3 multiDown;     // and through it
    float coatOut;      // directional albedo of the coat, weight included
    vec3 coatAbsorption; // logarithm of the coat's transmittance at normal incidence
    vec3 coatThrough;   // OpenPBR: what the coat lets through towards the viewer
    vec3 below;         // weight of all that is below the coat
    float fuzzOut;      // directional albedo of the fuzz, weight included
    float orenNayarOut; // directional albedo of the rough diffuse lobe, see orenNayarAlbedo
    vec4 lobeChance;    // of sampling coat, specular, diffuse, glass
    vec3 moreChance;    // of sampling light through the surface, fuzz, subsurface; sums to 1 with lobeChance
};

mat3 lobeFrame(Surface s) { return mat3(s.tangent, cross(s.ns, s.tangent), s.ns); }

// Reflectance of the interface from that of one facet or side: a sheet reflects at both sides and between them.
float sheetReflectance(Surface s, float reflectance) {
    float sheet = s.thinWalled ? s.transmission : 0.0;
    return mix(reflectance, 2.0 * reflectance / (1.0 + reflectance), sheet);
}

// The cosine of a direction in the film, 0 where it is totally reflected; `before` is the index on the viewer's side.
float cosineInFilm(Surface s, float cosine, float before) {
    float ratio = before / s.filmIor;
    return sqrt(max(0.0, 1.0 - ratio * ratio * (1.0 - cosine * cosine)));
}

// Reflectance of the interface met at `cosine`, film and second side included.
vec3 interfaceFresnel(Surface s, float cosine) {
    vec3 reflectance = vec3(dielectricFresnel(cosine, s.eta));
    if (s.film > 0.0) {
        float before = s.aroundIor * (s.inside ? 1.0 / s.eta : 1.0), beyond = s.aroundIor * (s.inside ? 1.0 : s.eta);
        float inFilm = cosineInFilm(s, cosine, before), upper = dielectricFresnel(cosine, s.filmIor / before);
        float lower = dielectricFresnel(inFilm, beyond / s.filmIor);
        float sign_ = (before - s.filmIor) * (s.filmIor - beyond) < 0.0 ? -1.0 : 1.0;
        vec3 filmed = filmReflectance(inFilm, s.filmIor, s.filmThickness, upper, vec3(lower), sign_);
        reflectance = mix(reflectance, filmed, s.film);
    }
    float sheet = s.thinWalled ? s.transmission : 0.0;
    return mix(reflectance, 2.0 * reflectance / (1.0 + reflectance), sheet);
}

// Schlick's term with the tint of the edge.
vec3 schlickMetal(Surface s, float cosine) {
    float grazing = 1.0 - cosine, weight = schlickWeight(cosine);
    return max(mix(s.f0, vec3(1.0), weight) - s.edge * (cosine * weight * grazing), 0.0);
}

// Reflectance of the metal, film included; the film's lower side turns the wave over as a dense dielectric does.
vec3 metalFresnel(Surface s, float cosine) {
    vec3 bare = schlickMetal(s, cosine);
    if (s.film == 0.0) return bare;
    float inFilm = cosineInFilm(s, cosine, 1.0), upper = dielectricFresnel(cosine, s.filmIor);
    float sign_ = s.filmIor < 1.0 ? -1.0 : 1.0;
    vec3 below = schlickMetal(s, inFilm);
    return mix(bare, filmReflectance(inFilm, s.filmIor, s.filmThickness, upper, below, sign_), s.film);
}

// Index of refraction kept off 1, where refraction has no direction of its own.
float usableIor(float ior) {
    ior = clamp(ior, 0.1, 10.0);
    return abs(ior - 1.0) < MIN_IOR_STEP ? 1.0 + MIN_IOR_STEP : ior;
}

void normalizeChances(inout Surface s) {
    float sum = dot(s.lobeChance, vec4(1.0)) + dot(s.moreChance, vec3(1.0));
    s.lobeChance = sum > 1e-6 ? s.lobeChance / sum : vec4(0.0, 0.0, 1.0, 0.0);
    s.moreChance = sum > 1e-6 ? s.moreChance / sum : vec3(0.0);
}
#endif
