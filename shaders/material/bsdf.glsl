// The scattering of a surface: evaluation, sampling and density. One set of lobes serves both material models.
//
//   fuzz + (1 - fuzzAlbedo) * (coat + below * (metal + interface + diffuse + transmission))
//
// metal         GGX reflection, height-correlated masking, Schlick Fresnel with a tint near the edge
// interface     GGX reflection of a dielectric; the transmission through it is rough refraction, Walter et al. 2007, or that
//               reflection turned over for sheets
// diffuse       Lambert or Oren-Nayar, reduced by what the interface reflects on the way in and out so that albedo 1
//               reflects exactly all: C. Kelemen and L. Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF
//               Model", EG 2001
// coat          GGX. UsdPreviewSurface: f0 0.04, and what is below is scaled by the smaller of the transmittances of both
//               directions, which is reciprocal and gives no energy away that the coat did not take. OpenPBR: a dielectric,
//               and what is below is scaled by what the coat does not reflect towards the viewer, which keeps all energy
//               and is not reciprocal
// A UsdPreviewSurface has f0 for the whole opaque part, metal or not, in the place of metal, and its glass as interface.
//
// Paths carry radiance over the squared index of the medium it is in (basic radiance), which refraction leaves
// unchanged: the eta^2 factors of Walter's eq. 21 cancel, no path gains weight inside glass, and an open sheet of glass
// does not darken what is behind it. An emitter inside a medium is thus specified in vacuum radiance.
#ifndef HIPR_MATERIAL_BSDF_GLSL
#define HIPR_MATERIAL_BSDF_GLSL
#include "material/lobe_shares.glsl"
#include "material/surface.glsl"

const uint LOBE_COAT = 0u;
const uint LOBE_SPECULAR = 1u;
const uint LOBE_DIFFUSE = 2u;
const uint LOBE_GLASS = 3u;
const uint LOBE_DIFFUSE_DOWN = 4u; // through the surface
const uint LOBE_FUZZ = 5u;
const uint LOBE_SUBSURFACE = 6u;   // into the medium below: no BSDF, evalBsdf leaves it out

LobeShares lobeShares; // of the last result of evalBsdfScaled(), which is their sum but for rounding

// The coat's axes in the frame of the lobes.
mat3 coatFrame(Surface s) {
    if (!sceneHas(SCENE_HAS_DIRECTIONS)) return mat3(1.0);
    const mat3 frame = lobeFrame(s);
    return mat3(s.coatTangent * frame, cross(s.coatNormal, s.coatTangent) * frame, s.coatNormal * frame);
}

// The coat's reflection, without its Fresnel term. `pdf`: the density with which a facet that o sees reflects
// it to i.
float coatReflection(Surface s, vec3 o, vec3 i, vec3 h, out float pdf) {
    if (sceneHas(SCENE_HAS_DIRECTIONS)) {
        const mat3 frame = coatFrame(s);
        o = o * frame, i = i * frame, h = h * frame;
        pdf = 0.0;
        if (o.z <= 0.0 || i.z <= 0.0) return 0.0;
    }
    const float visible = ggxDensity(h, s.coatAlpha) / (4.0 * o.z), lambda = 1.0 + ggxLambda(o, s.coatAlpha);
    pdf = visible / lambda;
    return visible / (lambda + ggxLambda(i, s.coatAlpha));
}

// The cosine of a direction in the frame of the lobes to the coat's normal.
float cosineToCoat(Surface s, vec3 i) {
    return sceneHas(SCENE_HAS_DIRECTIONS) ? clamp(dot(i, s.coatNormal * lobeFrame(s)), 0.0, 1.0) : i.z;
}

// What the base's microfacets do with light between `o` and `i`, local directions.
struct Facets {
    float cosine;  // of `o` to the facet
    vec3 fresnel;  // reflectance of the interface
    float visible; // density of the facet among those that `o` sees, over `cosine`
    float lambdaO, lambdaI;
};

Facets facetsBetween(Surface s, vec3 o, vec3 i, vec3 h) {
    Facets f;
    f.cosine = dot(o, h);
    f.lambdaO = ggxLambda(o, s.alpha);
    f.lambdaI = ggxLambda(i, s.alpha);
    f.visible = ggxDensity(h, s.alpha) / ((1.0 + f.lambdaO) * o.z);
    f.fresnel = s.transmission > 0.0 || s.openPbr ? interfaceFresnel(s, f.cosine) : vec3(0.0);
    return f;
}

// How often a sample of glass is reflected.
float reflectedShare(vec3 fresnel) { return (fresnel.x + fresnel.y + fresnel.z) / 3.0; }

// BRDF times cosine of a perfect mirror's facets.
float mirrored(Facets f) { return 0.25 * f.visible * (1.0 + f.lambdaO) / (1.0 + f.lambdaO + f.lambdaI); }

// What the interface lets through on the way in and out, of light that is scattered evenly below it; `in_` is its albedo
// towards the light. Under a film, whose mean albedo is not known, what it does not reflect towards the viewer: all
// energy is kept, but light may not be turned round.
vec3 coupling(Surface s, vec3 in_) {
    return (1.0 - s.interfaceOut) * (s.film > 0.0 ? vec3(1.0) : (1.0 - in_) / max(1.0 - s.interfaceMean, 1e-4));
}

// What the coupling lacks for rough diffuse light, which leaves near where it came from, and the interface reflects more of
// it there. Reciprocal; fitted so that all energy is kept to 0.7 %, see docs/materials.md.
vec3 roughCoupling(Surface s, vec3 in_) {
    if (s.diffuseRoughness == 0.0 || s.film > 0.0) return vec3(1.0);
    float slope = 0.07 * s.diffuseRoughness;
    return (1.0 + slope * (s.interfaceOut - s.interfaceMean)) * (1.0 + slope * (in_ - s.interfaceMean));
}

// All lobes that reflect; o and i are local and above the surface. result = f * cos.
vec3 evalReflection(Surface s, vec3 o, vec3 i, vec3 h, Facets facets, vec2 lobeScale, out float pdf) {
    vec3 specular = (s.metal * metalFresnel(s, facets.cosine) + s.dielectric * facets.fresnel) * mirrored(facets);
    vec2 single = facetAlbedo(s, i);

    float coatPdf, coat = s.coat * coatReflection(s, o, i, h, coatPdf);
    vec3 below = s.below, interfaceIn;
    if (s.openPbr) {
        vec2 towards = baseAlbedo(s, s.dense, i);
        interfaceIn = vec3(s.inside ? 0.0 : sheetReflectance(s, towards.x));
        float missing = 1.0 - single.x - single.y;
        float lost = s.thinWalled ? missing : 1.0 - towards.y;
        specular += (s.multiMetal * missing + s.multiUp * lost) * i.z / PI;
        coat *= dielectricFresnel(facets.cosine, s.coatEta);
        below *= mix(vec3(1.0), s.coatThrough * exp(s.coatAbsorption / cosineInCoat(s, cosineToCoat(s, i))), s.coat);
    } else {
        vec2 coatTowards = specularAlbedo(s.albedoTable, i.z, s.coatRoughness);
        interfaceIn = s.f0 * single.x + single.y;
        coat *= mix(COAT_F0, 1.0, schlickWeight(facets.cosine));
        below *= 1.0 - max(s.coatOut, s.coat * (COAT_F0 * coatTowards.x + coatTowards.y));
    }
    vec3 diffuse = orenNayar(s.diffuse, s.diffuseRoughness, o, i, s.orenNayarOut) * s.diffuseWeight;
    diffuse = diffuse * roughCoupling(s, interfaceIn) + s.scatterUp;
    diffuse *= coupling(s, interfaceIn) * i.z / PI;
    float fuzz = s.fuzz > 0.0 ? s.fuzz * fuzzReflection(o, i, s.fuzzRoughness) : 0.0;

    pdf = s.lobeChance.x * coatPdf +
          (s.lobeChance.y + s.lobeChance.w * reflectedShare(facets.fresnel)) * 0.25 * facets.visible + s.lobeChance.z * i.z / PI +
          s.moreChance.y / (2.0 * PI);
    vec3 shiny = coat + below * specular;
    lobeShares = LobeShares((1.0 - s.fuzzOut) * lobeScale.x * below * diffuse, lobeScale.x * fuzz * s.fuzzColor,
                            (1.0 - s.fuzzOut) * lobeScale.y * below * specular,
                            vec3((1.0 - s.fuzzOut) * lobeScale.y * coat), false);
    return (1.0 - s.fuzzOut) * (lobeScale.y * shiny + lobeScale.x * below * diffuse) + lobeScale.x * fuzz * s.fuzzColor;
}

// All lobes that transmit; i is below the surface. Refraction: Walter eqs. 17 and 21, in basic radiance.
vec3 evalTransmission(Surface s, vec3 o, vec3 i, vec3 h, Facets facets, vec2 lobeScale, out float pdf) {
    float cosI = dot(i, h), away = -i.z / PI;
    vec3 glass = vec3(0.0), diffuse = vec3(0.0);
    pdf = s.moreChance.x * away;
    if (s.glass > 0.0 && facets.cosine > 0.0 && (s.thinWalled || cosI < 0.0)) {
        float denominator = facets.cosine + s.eta * cosI, whole = 1.0 + facets.lambdaO;
        float refracted = facets.cosine * s.eta * s.eta * -cosI / (denominator * denominator);
        float density = facets.visible * (s.thinWalled ? 0.25 : refracted);
        float masked = s.thinWalled ? whole / (whole + facets.lambdaI) : 1.0 / (1.0 + facets.lambdaI);
        glass = s.glass * s.glassTint * (1.0 - facets.fresnel) * (density * masked);
        pdf += s.lobeChance.w * density * (1.0 - reflectedShare(facets.fresnel));
    }
    if (s.openPbr) {
        bool otherSide = s.thinWalled ? s.dense : !s.dense;
        vec2 towards = baseAlbedo(s, otherSide, i), single = facetAlbedo(s, i);
        glass += s.glassTint * s.multiDown * (s.thinWalled ? 1.0 - single.x - single.y : 1.0 - towards.y) * away;
        diffuse = s.scatterDown * coupling(s, vec3(sheetReflectance(s, towards.x))) * away;
    }
    vec3 below = s.openPbr ? s.below * mix(vec3(1.0), s.coatThrough, s.coat) : vec3(1.0 - s.coatOut);
    lobeShares = LobeShares((1.0 - s.fuzzOut) * below * lobeScale.x * diffuse, vec3(0.0),
                            (1.0 - s.fuzzOut) * below * lobeScale.y * glass, vec3(0.0), true);
    return (1.0 - s.fuzzOut) * below * (lobeScale.y * glass + lobeScale.x * diffuse);
}

// f * |cos| towards `wi` for the viewer direction `wo` (the one the surface was evaluated for), and the density with which
// sampleBsdf draws `wi`. `lobeScale` weighs the diffuse (x) and specular (y) response, for lights that ask for it.
vec3 evalBsdfScaled(Surface s, vec3 wo, vec3 wi, vec2 lobeScale, out float pdf) {
    pdf = 0.0;
    mat3 frame = lobeFrame(s);
    vec3 o = wo * frame, i = wi * frame; // transposed: to local
    bool above = dot(wi, s.ng) > 0.0;
    if (o.z <= 0.0 || above != (i.z > 0.0) || i.z == 0.0) return vec3(0.0);
    vec3 h = o + (above || s.thinWalled ? vec3(i.xy, abs(i.z)) : s.eta * i);
    h = normalize(h.z < 0.0 ? -h : h);
    Facets facets = facetsBetween(s, o, i, h);
    if (above) return evalReflection(s, o, i, h, facets, lobeScale, pdf);
    return evalTransmission(s, o, i, h, facets, lobeScale, pdf);
}

vec3 evalBsdf(Surface s, vec3 wo, vec3 wi, out float pdf) { return evalBsdfScaled(s, wo, wi, vec2(1.0), pdf); }

uint chooseLobe(Surface s, inout float u) {
    float below = 0.0;
    uint lobe = LOBE_COAT;
    float chance = s.lobeChance.x;
    if (u >= chance) below += chance, lobe = LOBE_SPECULAR, chance = s.lobeChance.y;
    if (u >= below + chance) below += chance, lobe = LOBE_DIFFUSE, chance = s.lobeChance.z;
    if (u >= below + chance) below += chance, lobe = LOBE_GLASS, chance = s.lobeChance.w;
    if (u >= below + chance && s.moreChance.x > 0.0) below += chance, lobe = LOBE_DIFFUSE_DOWN, chance = s.moreChance.x;
    if (u >= below + chance && s.moreChance.y > 0.0) below += chance, lobe = LOBE_FUZZ, chance = s.moreChance.y;
    if (u >= below + chance && s.moreChance.z > 0.0) below += chance, lobe = LOBE_SUBSURFACE, chance = s.moreChance.z;
    u = clamp((u - below) / max(chance, 1e-7), 0.0, 0.99999994);
    return lobe;
}

// Draws a direction; the density is evalBsdf's pdf. `lobe` (LOBE_*) tells which lobe drew it. Zero when the path ends: a
// steep microfacet may reflect down or refract up, where evalBsdf would take the direction for another event. A kernel
// that also evaluates a light's direction can call this and run evalBsdfScaled for both in one loop.
vec3 sampleBsdfDirection(Surface s, vec3 wo, vec4 u, out uint lobe) {
    mat3 frame = lobeFrame(s);
    vec3 o = wo * frame;
    float rest = u.z;
    lobe = chooseLobe(s, rest);
    if (lobe == LOBE_DIFFUSE || lobe >= LOBE_DIFFUSE_DOWN) {
        float z = lobe == LOBE_FUZZ ? u.x : sqrt(max(0.0, 1.0 - u.x)); // even over the hemisphere, or by the cosine
        float r = sqrt(max(0.0, 1.0 - z * z)), phi = 2.0 * PI * u.y;
        return frame * vec3(r * cos(phi), r * sin(phi), lobe == LOBE_DIFFUSE_DOWN || lobe == LOBE_SUBSURFACE ? -z : z);
    }
    vec3 h;
    if (sceneHas(SCENE_HAS_DIRECTIONS) && lobe == LOBE_COAT) {
        const mat3 coat = coatFrame(s);
        h = coat * sampleVisibleNormal(o * coat, s.coatAlpha, u.xy);
        if (dot(2.0 * dot(o, h) * h - o, coat[2]) <= 0.0) return vec3(0.0);
    } else {
        h = sampleVisibleNormal(o, lobe == LOBE_COAT ? s.coatAlpha : s.alpha, u.xy);
    }
    float cosine = dot(o, h);
    vec3 reflected = 2.0 * cosine * h - o;
    if (lobe == LOBE_GLASS && u.w >= reflectedShare(interfaceFresnel(s, cosine))) {
        if (s.thinWalled) return reflected.z > 0.0 ? frame * vec3(reflected.xy, -reflected.z) : vec3(0.0);
        vec3 refracted = refractedBy(h, o, cosine, s.eta);
        return refracted.z < 0.0 ? frame * refracted : vec3(0.0);
    }
    return reflected.z > 0.0 ? frame * reflected : vec3(0.0);
}

// The weight of a path that enters the medium below in a direction drawn from LOBE_SUBSURFACE.
vec3 subsurfaceWeight(Surface s, vec3 wi) {
    if (dot(wi, s.ng) >= 0.0) return vec3(0.0);
    vec3 below = s.below * mix(vec3(1.0), s.coatThrough, s.coat);
    return (1.0 - s.fuzzOut) * below * (1.0 - s.interfaceOut) * (s.subsurface / s.moreChance.z);
}

// Draws a direction with weight f * |cos| / pdf; pdf is below 0 for LOBE_SUBSURFACE, which no light is sampled for. False:
// the path ends here (the direction leaves on the wrong side of the geometric surface, or carries nothing).
bool sampleBsdf(Surface s, vec3 wo, vec4 u, out vec3 wi, out vec3 weight, out float pdf, out uint lobe) {
    wi = sampleBsdfDirection(s, wo, u, lobe);
    vec3 f = evalBsdf(s, wo, wi, pdf);
    weight = pdf > 0.0 ? f / pdf : vec3(0.0);
    if (lobe == LOBE_SUBSURFACE) weight = subsurfaceWeight(s, wi), pdf = -1.0;
    return any(greaterThan(weight, vec3(0.0)));
}
#endif
