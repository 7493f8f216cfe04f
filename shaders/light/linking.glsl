// Light linking: sets of categories that objects are in (renderer/shading/categories.h).
#ifndef HIPR_LIGHT_LINKING_GLSL
#define HIPR_LIGHT_LINKING_GLSL
#include "shared/references.glsl"

// Whether an object in the categories of `set` is in `category`; NO_INDEX stands for all objects.
bool inCategory(SceneRecord scene, uint set, uint category) {
    if (category == NO_INDEX) return true;
    uint word = UintRef(scene.categorySets).v[set * scene.categoryWords + (category >> 5)];
    return (word >> (category & 31u) & 1u) != 0u;
}
#endif
