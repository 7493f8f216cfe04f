// The opacity of a hit alone, for shadow rays that go through surfaces: everything else of the surface is skipped.
#ifndef HIPR_MATERIAL_PRESENCE_GLSL
#define HIPR_MATERIAL_PRESENCE_GLSL
#include "material/inputs.glsl"

// The part of light the surface at `hit` stops at that time: Surface::opacity.
float evaluatePresence(SceneRecord scene, Hit hit, float time) {
    ShadingPoint point = shadingPoint(scene, hit);
    moveTo(point, scene, time);
    uint material = materialIndex(scene, point);
    MaterialRecord record = MaterialRef(scene.materials).v[material];
    if ((record.flags & MATERIAL_PRESENCE) == 0u) return 1.0;
    return presenceOf(record.flags, evaluateInputs(scene, point, record, record.presenceSteps));
}
#endif
