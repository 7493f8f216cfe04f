// Directional albedos of stretched lobes, from the table that renderer/shading/stretched_albedo.h describes.
#ifndef HIPR_MATERIAL_STRETCHED_ALBEDO_GLSL
#define HIPR_MATERIAL_STRETCHED_ALBEDO_GLSL
#include "shared/references.glsl"

// A point of the table's rows: the lowest of the eight around it by plane, anisotropy and roughness, and the weights of
// the next ones.
struct StretchedPlace {
    uvec3 low;
    vec3 weight;
};

const float STRETCHED_MIRROR = float(2u * STRETCHED_STEPS); // the plane of a perfect mirror

// The plane of an interface, between two of the table's.
float stretchedPlane(bool inside, float indexStep) {
    float at = sqrt(clamp(indexStep / INTERFACE_MOST, 0.0, 1.0)) * float(STRETCHED_STEPS - 1u);
    return at + (inside ? float(STRETCHED_STEPS) : 0.0);
}

// Anisotropies lie denser near 1, where lobes are narrowest.
StretchedPlace stretchedPlace(float plane, float anisotropy, float roughness) {
    vec3 at = vec3(plane, (1.0 - sqrt(clamp(1.0 - anisotropy, 0.0, 1.0))) * float(STRETCHED_ANISOTROPIES - 1u),
                   clamp(roughness, 0.0, 1.0) * float(STRETCHED_ROUGHNESSES - 1u));
    uvec3 low = min(uvec3(at), uvec3(STRETCHED_PLANES, STRETCHED_ANISOTROPIES, STRETCHED_ROUGHNESSES) - 2u);
    return StretchedPlace(low, at - vec3(low));
}

// The first entry of one of the eight rows, and its share.
uint stretchedRow(StretchedPlace place, uint corner, out float share) {
    uvec3 next = uvec3(corner & 1u, corner >> 1 & 1u, corner >> 2);
    vec3 shares = mix(1.0 - place.weight, place.weight, vec3(next));
    share = shares.x * shares.y * shares.z;
    uvec3 at = place.low + next;
    return ((at.x * STRETCHED_ANISOTROPIES + at.y) * STRETCHED_ROUGHNESSES + at.z) * STRETCHED_ROW;
}

// What facets do with light from `w` (in the frame of the lobe): the part reflected, and that plus the part transmitted.
vec2 stretchedAlbedo(uint64_t table, StretchedPlace place, vec3 w) {
    Vec2Ref entries = Vec2Ref(table);
    float across = length(w.xy);
    vec2 at = vec2(across > 0.0 ? min(abs(w.x) / across, 1.0) : 1.0, sqrt(clamp(abs(w.z), 0.0, 1.0)));
    at *= vec2(float(STRETCHED_AZIMUTHS - 1u), float(STRETCHED_COSINES - 1u));
    uvec2 low = min(uvec2(at), uvec2(STRETCHED_AZIMUTHS, STRETCHED_COSINES) - 2u);
    vec2 weight = at - vec2(low), sum = vec2(0.0);
    for (uint corner = 0u; corner < 8u; ++corner) {
        float share;
        uint i = stretchedRow(place, corner, share) + low.x * STRETCHED_COSINES + low.y;
        vec2 here = mix(entries.v[i], entries.v[i + 1u], weight.y);
        vec2 next = mix(entries.v[i + STRETCHED_COSINES], entries.v[i + STRETCHED_COSINES + 1u], weight.y);
        sum += share * mix(here, next, weight.x);
    }
    return sum;
}

// The same, averaged over the hemisphere with cosine weight.
vec2 meanStretchedAlbedo(uint64_t table, StretchedPlace place) {
    Vec2Ref entries = Vec2Ref(table);
    vec2 sum = vec2(0.0);
    for (uint corner = 0u; corner < 8u; ++corner) {
        float share;
        uint row = stretchedRow(place, corner, share);
        sum += share * entries.v[row + STRETCHED_ROW - 1u];
    }
    return sum;
}
#endif
