// Which slot of an object a triangle belongs to, and what that is called.
#ifndef HIPR_MATERIAL_SLOT_GLSL
#define HIPR_MATERIAL_SLOT_GLSL
#include "shared/references.glsl"

layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer SlotNamesRef { SlotNames v[]; };

// Where the slot of a triangle is among those of all objects; of instances that have any.
uint slotIndex(InstanceRecord instance, GeometryRecord geometry, uint primitive) {
    uint slot = 0u;
    if (geometry.triangleSlot != 0ul) slot = uint(Uint16Ref(geometry.triangleSlot).v[primitive]);
    return instance.firstMaterial + min(slot, instance.materialCount - 1u);
}

// The same of what a ray has met, NO_INDEX: none.
uint slotAt(SceneRecord scene, Hit hit) {
    const InstanceRecord instance = InstanceRef(scene.instances).v[hit.instance];
    if (instance.materialCount == 0u) return NO_INDEX;
    return slotIndex(instance, GeometryRef(scene.geometries).v[instance.geometry], hit.primitive);
}

// The light group of an emissive surface.
uint lightGroupAt(SceneRecord scene, Hit hit) {
    const uint slot = slotAt(scene, hit);
    return slot == NO_INDEX || scene.slotNames == 0ul ? NO_INDEX : SlotNamesRef(scene.slotNames).v[slot].lightGroup;
}
#endif
