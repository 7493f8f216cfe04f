// Objects of glass and liquids that overlap: C. Schmidt and B. Budge, "Simple Nested Dielectrics in Ray Traced Images",
// 2002. A path knows the refractive materials it is inside of. Where several are, that of the highest priority is what is
// there, of several that which was entered last; surfaces of others are passed as if they were not. Only scenes with
// SCENE_HAS_NESTING.
#ifndef HIPR_MATERIAL_NESTING_GLSL
#define HIPR_MATERIAL_NESTING_GLSL
#include "shared/features.glsl"
#include "shared/references.glsl"

// As many as a path can be inside of; further ones are not noticed. In the order in which they were entered, each has 16
// bits: 1 + its MaterialRecord, or 0.
const uint INTERIORS = 4u;

uint interiorAt(uvec2 interiors, uint i) { return interiors[i >> 1] >> (16u * (i & 1u)) & 0xffffu; }

uvec2 withInterior(uvec2 interiors, uint i, uint interior) {
    const uint shift = 16u * (i & 1u);
    interiors[i >> 1] = interiors[i >> 1] & ~(0xffffu << shift) | interior << shift;
    return interiors;
}

// Where an interior was entered last, INTERIORS: nowhere.
uint findInterior(uvec2 interiors, uint interior) {
    uint found = INTERIORS;
    for (uint i = 0u; i < INTERIORS; ++i)
        if (interiorAt(interiors, i) == interior) found = i;
    return found;
}

// What a path is inside of once it has crossed a surface of `material`.
uvec2 crossedInteriors(uvec2 interiors, uint material, bool entering) {
    if (entering) {
        uint free = INTERIORS;
        for (uint i = INTERIORS; i > 0u; --i)
            if (interiorAt(interiors, i - 1u) == 0u) free = i - 1u;
        return free < INTERIORS ? withInterior(interiors, free, material + 1u) : interiors;
    }
    for (uint i = findInterior(interiors, material + 1u); i < INTERIORS; ++i)
        interiors = withInterior(interiors, i, i + 1u < INTERIORS ? interiorAt(interiors, i + 1u) : 0u);
    return interiors;
}

// The material of the highest priority, of several the one that was entered last; NO_INDEX: none.
uint foremostInterior(SceneRecord scene, uvec2 interiors) {
    uint foremost = NO_INDEX;
    for (uint i = 0u; i < INTERIORS; ++i) {
        const uint interior = interiorAt(interiors, i);
        if (interior == 0u) continue;
        MaterialRef materials = MaterialRef(scene.materials);
        if (foremost == NO_INDEX || materials.v[interior - 1u].priority >= materials.v[foremost].priority)
            foremost = interior - 1u;
    }
    return foremost;
}
#endif
