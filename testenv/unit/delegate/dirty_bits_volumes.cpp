#include "testenv/unit/delegate/dirty_bits_rows.h"

#include "pxr/base/gf/vec3f.h"
#include "pxr/imaging/hd/field.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

namespace {

Apply field(HdDirtyBits bits, Edit edit = noEdit) {
    return [=](World& world, bool make) {
        edit(world.prim("/fog.density"), make);
        world.tracker().MarkBprimDirty(SdfPath("/fog.density"), bits);
    };
}

/// The medium that a volume terminal is made of.
void thicken(TestScene::Prim& prim, bool make) {
    auto networks = prim.resource.UncheckedGet<HdMaterialNetworkMap>();
    HdMaterialNode& node = networks.map.at(HdMaterialTerminalTokens->volume).nodes.front();
    node.parameters[TfToken("absorption")] = VtValue(GfVec3f(make ? 2.f : 1.f));
    prim.resource = VtValue(networks);
}

void loseField(TestScene::Prim& prim, bool make) {
    prim.fields.clear();
    prim.fields.emplace_back(TfToken(make ? "temperature" : "density"), TfToken("openvdbAsset"),
                             SdfPath("/fog.density"));
}

} // namespace

Section volumeSection() {
    const Elements moved = {{Target::Fog, Change::Transform, 0}},
                   visibility = {{Target::Fog, Change::Visibility}},
                   geometry = {{Target::Fog, Change::Geometry}}, material = {{Target::Fog, Change::Material}};
    const Edit denser = values("hipr:volume:density", 2.f, 1.f);
    return {
        "Volume",
        "An element is the object of the volume, as with meshes. Its fields are prims of their own, below.",
        {
            {"HdChangeTracker::DirtyVolumeField", "which fields it has, and what for",
             "density becomes temperature", rprim("/fog", Bits::DirtyVolumeField, loseField), geometry},
            {"HdChangeTracker::DirtyPrimvar", "the primvars `hipr:volume:*`", "it becomes denser",
             rprim("/fog", Bits::DirtyPrimvar, denser), material},
            {"HdChangeTracker::DirtyMaterialId", "the material's path", "another material is bound",
             rprim("/fog", Bits::DirtyMaterialId,
                   [](TestScene::Prim& prim, bool make) {
                       prim.material = make ? SdfPath("/mist") : SdfPath();
                   }),
             material},
            {"HdChangeTracker::DirtyTransform", "the transform", "it moves",
             rprim("/fog", Bits::DirtyTransform, move), moved},
            {"HdChangeTracker::DirtyVisibility", "visibility", "it hides",
             rprim("/fog", Bits::DirtyVisibility,
                   [](TestScene::Prim& prim, bool make) { prim.visible = !make; }),
             visibility},
            {"HdChangeTracker::DirtyRenderTag", "the render tag; the render pass tells which are seen",
             "its purpose becomes guide",
             rprim("/fog", Bits::DirtyRenderTag,
                   [](TestScene::Prim& prim, bool make) {
                       prim.renderTag = make ? HdRenderTagTokens->guide : HdRenderTagTokens->geometry;
                   }),
             visibility},
            {"HdChangeTracker::DirtyPrimID",
             "the prim id, for the AOV",
             "Hydra gives out ids anew",
             setPrimId("/fog", 1236),
             {{Target::Fog, Change::Primvar}}},
            {"HdChangeTracker::DirtyCategories",
             "the lights' collections that it is in",
             "it joins one",
             rprim("/fog", Bits::DirtyCategories,
                   [](TestScene::Prim& prim, bool make) { prim.categories = categories(make); }),
             {{Target::Fog, Change::Linking}}},
            nothing("/fog", "HdChangeTracker::DirtyInstancer", Bits::DirtyInstancer,
                    "transform and instances"),
            nothing("/fog", "HdChangeTracker::DirtyInstanceIndex", Bits::DirtyInstanceIndex,
                    "transform and instances"),
            nothing("/fog", "HdChangeTracker::DirtyExtent", Bits::DirtyExtent,
                    "nothing: the renderer bounds what it has got"),
            nothing("/fog", "HdChangeTracker::DirtyRepr", Bits::DirtyRepr,
                    "nothing: there is one way to draw volumes"),
            {"HdChangeTracker::AllDirty", "everything; only what differs is a change", "it becomes denser",
             rprim("/fog", Bits::AllDirty, denser), material},
        }};
}

Section fieldSection() {
    const Elements geometry = {{Target::Fog, Change::Geometry}};
    const Edit other = param("fieldName", TfToken("thin"), TfToken("density"));
    return {"Field (openvdbAsset)",
            "A field is no element: those that change are the objects of the volumes that have it. A file is "
            "read "
            "again when it was written since, or when nobody holds what was read.",
            {
                {"HdField::DirtyParams", "file, name and index; the grid, if another is meant",
                 "another grid is named", field(HdField::DirtyParams, other), geometry},
                {"HdField::DirtyTransform",
                 "nothing: a volume places its fields",
                 "",
                 field(HdField::DirtyTransform),
                 {}},
                {"HdField::AllDirty", "file, name and index", "another grid is named",
                 field(HdField::AllDirty, other), geometry},
                {"HdField::Clean", "nothing; Hydra refuses to mark it", "", [](World&, bool) {}, {}},
                {"HdMaterial::DirtyResource",
                 "of a material: its volume terminal, too",
                 "absorption grows",
                 sprim("/mist", HdMaterial::DirtyResource, thicken),
                 {{Target::Mist, Change::Material}}},
            }};
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
