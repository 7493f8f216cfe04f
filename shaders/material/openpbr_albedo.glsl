// Directional albedos from the tables that renderer/shading/openpbr_albedo.h describes.
#ifndef HIPR_MATERIAL_OPENPBR_ALBEDO_GLSL
#define HIPR_MATERIAL_OPENPBR_ALBEDO_GLSL
#include "shared/references.glsl"

// A point of the interface's table: where a row begins, and the weights of the rows after it in both directions.
struct InterfaceCell {
    uint row;
    vec2 weight; // of the next index, the next roughness
};

const uint INTERFACE_ROW = INTERFACE_COSINES + 1u;
const uint INTERFACE_PLANE = INTERFACE_ROUGHNESSES * INTERFACE_ROW;

InterfaceCell interfaceCell(bool inside, float indexStep, float roughness) {
    float x = sqrt(clamp(indexStep / INTERFACE_MOST, 0.0, 1.0)) * float(INTERFACE_STEPS - 1u);
    float y = clamp(roughness, 0.0, 1.0) * float(INTERFACE_ROUGHNESSES - 1u);
    uint i = min(uint(x), INTERFACE_STEPS - 2u), j = min(uint(y), INTERFACE_ROUGHNESSES - 2u);
    uint first = inside ? INTERFACE_STEPS * INTERFACE_PLANE : 0u;
    return InterfaceCell(first + i * INTERFACE_PLANE + j * INTERFACE_ROW, vec2(x - float(i), y - float(j)));
}

vec2 interfaceValue(uint64_t table, InterfaceCell cell, uint column) {
    Vec2Ref entries = Vec2Ref(table);
    uint at = cell.row + column;
    vec2 low = mix(entries.v[at], entries.v[at + INTERFACE_ROW], cell.weight.y);
    at += INTERFACE_PLANE;
    vec2 high = mix(entries.v[at], entries.v[at + INTERFACE_ROW], cell.weight.y);
    return mix(low, high, cell.weight.x);
}

// What a rough dielectric interface does with light from a direction: the part reflected, and that plus the part
// transmitted, both without what several microfacets scatter.
vec2 interfaceAlbedo(uint64_t table, InterfaceCell cell, float cosine) {
    float x = sqrt(clamp(cosine, 0.0, 1.0)) * float(INTERFACE_COSINES - 1u);
    uint i = min(uint(x), INTERFACE_COSINES - 2u);
    return mix(interfaceValue(table, cell, i), interfaceValue(table, cell, i + 1u), x - float(i));
}

// The same, averaged over the hemisphere with cosine weight.
vec2 meanInterfaceAlbedo(uint64_t table, InterfaceCell cell) {
    return interfaceValue(table, cell, INTERFACE_COSINES);
}

// The part of light from a direction that white fuzz reflects.
float fuzzAlbedo(uint64_t table, float cosine, float roughness) {
    FloatRef entries = FloatRef(table);
    float x = sqrt(clamp(cosine, 0.0, 1.0)) * float(FUZZ_COSINES - 1u);
    float y = (roughness - FUZZ_LEAST_ROUGHNESS) / (1.0 - FUZZ_LEAST_ROUGHNESS) * float(FUZZ_ROUGHNESSES - 1u);
    uint i = min(uint(x), FUZZ_COSINES - 2u), j = min(uint(y), FUZZ_ROUGHNESSES - 2u);
    uint at = 4u * INTERFACE_STEPS * INTERFACE_PLANE + j * FUZZ_COSINES + i; // two floats an entry, two sides
    float low = mix(entries.v[at], entries.v[at + 1u], x - float(i));
    at += FUZZ_COSINES;
    return mix(low, mix(entries.v[at], entries.v[at + 1u], x - float(i)), y - float(j));
}
#endif
