// Light linking: sets of categories that objects are in (renderer/shading/categories.h). Of each set there are its mark and
// the bits of its categories.
#ifndef HIPR_LIGHT_LINKING_GLSL
#define HIPR_LIGHT_LINKING_GLSL
#include "shared/references.glsl"

// Whether an object in the categories of `set` is in `category`; NO_INDEX stands for all objects.
bool inCategory(SceneRecord scene, uint set, uint category) {
    if (category == NO_INDEX) return true;
    uint word = UintRef(scene.categorySets).v[set * (scene.categoryWords + 1u) + 1u + (category >> 5)];
    return (word >> (category & 31u) & 1u) != 0u;
}

// A node of the tree of lights has lights for an object in the categories of `set` only if its LightNode::links and this
// have a bit in common. The last bit is that of lights without a link.
uint linksOf(SceneRecord scene, uint set) {
    uint mark = scene.categoryWords == 0u ? 0u : UintRef(scene.categorySets).v[set * (scene.categoryWords + 1u)];
    return mark | 0x80000000u;
}
#endif
