// The scattering of a UsdPreviewSurface: evaluation, sampling and density.
//
//   coat + (1 - coatAlbedo) * ((1 - glass) * (specular + diffuse) + glass * interface)
//
// specular   GGX reflection, height-correlated masking, Schlick Fresnel from f0 to 1
// diffuse    Lambert, reduced by what specular reflects on the way in and out so that albedo 1 reflects exactly all:
//            C. Kelemen and L. Szirmay-Kalos, "A Microfacet Based Coupled Specular-Matte BRDF Model", EG 2001
// coat       GGX, f0 0.04; what is below it is scaled by the smaller of the transmittances of both directions,
//            which is reciprocal and gives no energy away that the coat did not take
// interface  rough dielectric reflection and refraction, Walter et al. 2007
//
// Paths carry radiance over the squared index of the medium it is in (basic radiance), which refraction leaves
// unchanged: the eta^2 factors of Walter's eq. 21 cancel, no path gains weight inside glass, and an open sheet of glass
// does not darken what is behind it. An emitter inside a medium is thus specified in vacuum radiance.
#ifndef HIPR_MATERIAL_BSDF_GLSL
#define HIPR_MATERIAL_BSDF_GLSL
#include "material/surface.glsl"

const uint LOBE_COAT = 0u;
const uint LOBE_SPECULAR = 1u;
const uint LOBE_DIFFUSE = 2u;
const uint LOBE_GLASS = 3u;

// Reflection of one GGX lobe without Fresnel, times the cosine; `pdf` of sampling it through visible normals.
float evalGgx(vec3 o, vec3 i, vec3 h, float alpha, out float pdf) {
    float facets = ggxDensity(h, alpha) / (4.0 * o.z);
    float lambda = ggxLambda(o, alpha);
    pdf = facets / (1.0 + lambda);
    return facets / (1.0 + lambda + ggxLambda(i, alpha));
}

// All reflection lobes; o and i are local and above the surface. result = f * cos.
vec3 evalReflection(Surface s, vec3 o, vec3 i, vec2 lobeScale, out float pdf) {
    vec3 h = normalize(o + i);
    float cosine = dot(o, h);
    float pdfSpecular, pdfCoat;
    float ggx = evalGgx(o, i, h, s.alpha, pdfSpecular);
    float coatGgx = evalGgx(o, i, h, s.coatAlpha, pdfCoat);
    float weight = schlickWeight(cosine);
    vec2 towardsLight = specularAlbedo(s.albedoTable, i.z, s.roughness);
    vec2 coatTowardsLight = specularAlbedo(s.albedoTable, i.z, s.coatRoughness);

    float interfaceFresnel = s.glass > 0.0 ? dielectricFresnel(cosine, s.eta) : 0.0;
    vec3 specular = mix(mix(s.f0, vec3(1.0), weight), vec3(interfaceFresnel), s.glass) * ggx;
    vec3 specularIn = s.f0 * towardsLight.x + towardsLight.y;
    vec3 diffuse = s.diffuse * (1.0 - s.specularOut) * (1.0 - specularIn) / max(1.0 - s.specularMean, 1e-4);
    diffuse *= (1.0 - s.glass) * i.z / PI;

    float coatIn = s.coat * (COAT_F0 * coatTowardsLight.x + coatTowardsLight.y);
    float below = 1.0 - max(s.coatOut, coatIn);
    float coat = s.coat * mix(COAT_F0, 1.0, weight) * coatGgx;

    pdf = s.lobeChance.x * pdfCoat + (s.lobeChance.y + s.lobeChance.w * interfaceFresnel) * pdfSpecular +
          s.lobeChance.z * i.z / PI;
    return lobeScale.y * (coat + below * specular) + lobeScale.x * below * diffuse;
}

// Refraction through the interface: Walter eqs. 17 and 21, in basic radiance. i is below the surface.
vec3 evalRefraction(Surface s, vec3 o, vec3 i, vec2 lobeScale, out float pdf) {
    pdf = 0.0;
    vec3 h = o + s.eta * i;
    h = normalize(h.z < 0.0 ? -h : h);
    float cosO = dot(o, h), cosI = dot(i, h);
    if (s.glass == 0.0 || cosO <= 0.0 || cosI >= 0.0) return vec3(0.0);
    float denominator = cosO + s.eta * cosI;
    float transmitted = 1.0 - dielectricFresnel(cosO, s.eta);
    float visible = ggxDensity(h, s.alpha) * cosO / ((1.0 + ggxLambda(o, s.alpha)) * o.z);
    float density = visible * transmitted * s.eta * s.eta * -cosI / (denominator * denominator);
    pdf = s.lobeChance.w * density;
    return vec3(lobeScale.y * (1.0 - s.coatOut) * s.glass * density / (1.0 + ggxLambda(i, s.alpha)));
}

// f * |cos| towards `wi` for the viewer direction `wo` (the one the surface was evaluated for), and the density with which
// sampleBsdf draws `wi`. `lobeScale` weighs the diffuse (x) and specular (y) response, for lights that ask for it.
vec3 evalBsdfScaled(Surface s, vec3 wo, vec3 wi, vec2 lobeScale, out float pdf) {
    pdf = 0.0;
    mat3 frame = frameAround(s.ns);
    vec3 o = wo * frame, i = wi * frame; // transposed: to local
    bool above = dot(wi, s.ng) > 0.0;
    if (o.z <= 0.0 || above != (i.z > 0.0) || i.z == 0.0) return vec3(0.0);
    if (above) return evalReflection(s, o, i, lobeScale, pdf);
    return evalRefraction(s, o, i, lobeScale, pdf);
}

vec3 evalBsdf(Surface s, vec3 wo, vec3 wi, out float pdf) { return evalBsdfScaled(s, wo, wi, vec2(1.0), pdf); }

uint chooseLobe(Surface s, inout float u) {
    float below = 0.0;
    uint lobe = LOBE_COAT;
    float chance = s.lobeChance.x;
    if (u >= chance) below += chance, lobe = LOBE_SPECULAR, chance = s.lobeChance.y;
    if (u >= below + chance) below += chance, lobe = LOBE_DIFFUSE, chance = s.lobeChance.z;
    if (u >= below + chance) below += chance, lobe = LOBE_GLASS, chance = s.lobeChance.w;
    u = clamp((u - below) / max(chance, 1e-7), 0.0, 0.99999994);
    return lobe;
}

// Draws a direction; the density is evalBsdf's pdf. `lobe` (LOBE_*) tells which lobe drew it. Zero when the path ends: a
// steep microfacet may reflect down or refract up, where evalBsdf would take the direction for another event. A kernel
// that also evaluates a light's direction can call this and run evalBsdfScaled for both in one loop.
vec3 sampleBsdfDirection(Surface s, vec3 wo, vec4 u, out uint lobe) {
    mat3 frame = frameAround(s.ns);
    vec3 o = wo * frame;
    float rest = u.z;
    lobe = chooseLobe(s, rest);
    if (lobe == LOBE_DIFFUSE) {
        float r = sqrt(u.x), phi = 2.0 * PI * u.y;
        return frame * vec3(r * cos(phi), r * sin(phi), sqrt(max(0.0, 1.0 - u.x)));
    }
    vec3 h = sampleVisibleNormal(o, lobe == LOBE_COAT ? s.coatAlpha : s.alpha, u.xy);
    float cosine = dot(o, h);
    if (lobe == LOBE_GLASS && u.w >= dielectricFresnel(cosine, s.eta)) {
        float inverse = 1.0 / s.eta; // Snell's law: Walter eq. 40
        float cosT = sqrt(max(0.0, 1.0 - inverse * inverse * (1.0 - cosine * cosine)));
        vec3 refracted = normalize((inverse * cosine - cosT) * h - inverse * o);
        return refracted.z < 0.0 ? frame * refracted : vec3(0.0);
    }
    vec3 reflected = 2.0 * cosine * h - o;
    return reflected.z > 0.0 ? frame * reflected : vec3(0.0);
}

// Draws a direction with weight f * |cos| / pdf. False: the path ends here (the direction leaves on the wrong side of the
// geometric surface, or carries nothing).
bool sampleBsdf(Surface s, vec3 wo, vec4 u, out vec3 wi, out vec3 weight, out float pdf, out uint lobe) {
    wi = sampleBsdfDirection(s, wo, u, lobe);
    vec3 f = evalBsdf(s, wo, wi, pdf);
    weight = pdf > 0.0 ? f / pdf : vec3(0.0);
    return any(greaterThan(weight, vec3(0.0)));
}
#endif
