// What a kernel is specialised by. Branches on sceneHas() cost nothing, and what they lead to is no part of a kernel for
// scenes without: shading has to do without on most pictures.
#ifndef HIPR_SHARED_FEATURES_GLSL
#define HIPR_SHARED_FEATURES_GLSL
#include "shared/scene.h"

layout(constant_id = 0) const uint SCENE_FEATURES = 0xffffffffu; // SCENE_HAS_*

bool sceneHas(uint feature) { return (SCENE_FEATURES & feature) != 0u; }
#endif
