#include "testenv/unit/delegate/dirty_bits_rows.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

namespace {

const VtVec3fArray before = {{-0.25f, 0, 0}, {0.25f, 0, 0}}, after = {{-0.25f, 0, 0}, {0.25f, 0.5f, 0}};

void hideSecond(World& world, bool make, HdDirtyBits bits) {
    world.prim("/clouds").indices[SdfPath("/clouds.cloud")] = make ? VtIntArray{0} : VtIntArray{0, 1};
    world.tracker().MarkRprimDirty(SdfPath("/clouds.cloud"), bits);
}

Apply hideSecond(HdDirtyBits bits) {
    return [=](World& world, bool make) { hideSecond(world, make, bits); };
}

} // namespace

Section particleFieldSection() {
    const Elements geometry = {{Target::Cloud, Change::Geometry}},
                   moved = {{Target::Cloud, Change::Transform, 0}},
                   visibility = {{Target::Cloud, Change::Visibility}},
                   gone = instances(Target::Clouds, Change::Removed, {1}),
                   back = instances(Target::Clouds, Change::Added, {1});
    const Edit moveOne = values("positions", after, before);
    return {
        "Particle field (splats)",
        "An element is the object of the cloud, as with meshes. Hydra has no bit for one array of a cloud: "
        "all are "
        "read, and the renderer compares. Paths do not meet splats, so that these edits leave the samples of "
        "the picture alone.",
        {
            {"HdChangeTracker::DirtyPrimvar", "all values", "a splat moves",
             rprim("/cloud", Bits::DirtyPrimvar, moveOne), geometry},
            {"HdChangeTracker::DirtyPrimvar", "all values", "the opacities change",
             rprim("/cloud", Bits::DirtyPrimvar,
                   [](TestScene::Prim& prim, bool make) {
                       prim.primvars[TfToken("opacities")] = {HdInterpolationVertex,
                                                              VtValue(VtFloatArray(2, make ? 0.5f : 1.f))};
                   }),
             geometry},
            {"HdChangeTracker::DirtyPoints", "all values", "a splat moves",
             rprim("/cloud", Bits::DirtyPoints, moveOne), geometry},
            {"HdChangeTracker::DirtyTransform", "the transform", "it moves",
             rprim("/cloud", Bits::DirtyTransform, move), moved},
            {"HdChangeTracker::DirtyTransform", "transform and instances",
             "the prototype of an instancer moves", rprim("/clouds.cloud", Bits::DirtyTransform, move),
             instances(Target::Clouds, Change::Transform, {0, 1})},
            {"HdChangeTracker::DirtyInstancer", "transform and instances", "one instance is hidden",
             hideSecond(Bits::DirtyInstancer), gone, back},
            {"HdChangeTracker::DirtyInstanceIndex", "transform and instances", "one instance is hidden",
             hideSecond(Bits::DirtyInstanceIndex), gone, back},
            {"HdChangeTracker::DirtyVisibility", "visibility", "it hides",
             rprim("/cloud", Bits::DirtyVisibility,
                   [](TestScene::Prim& prim, bool make) { prim.visible = !make; }),
             visibility},
            {"HdChangeTracker::DirtyRenderTag", "the render tag; the render pass tells which are seen",
             "its purpose becomes guide",
             rprim("/cloud", Bits::DirtyRenderTag,
                   [](TestScene::Prim& prim, bool make) {
                       prim.renderTag = make ? HdRenderTagTokens->guide : HdRenderTagTokens->geometry;
                   }),
             visibility},
            {"HdChangeTracker::DirtyPrimID",
             "the prim id, for the AOV",
             "Hydra gives out ids anew",
             setPrimId("/cloud", 1235),
             {{Target::Cloud, Change::Primvar}}},
            nothing("/cloud", "HdChangeTracker::DirtyMaterialId", Bits::DirtyMaterialId,
                    "nothing: splats have no material"),
            nothing("/cloud", "HdChangeTracker::DirtyTopology", Bits::DirtyTopology,
                    "nothing: splats have no topology"),
            nothing("/cloud", "HdChangeTracker::DirtyDisplayStyle", Bits::DirtyDisplayStyle,
                    "nothing: there is one way to draw splats"),
            nothing("/cloud", "HdChangeTracker::DirtyRepr", Bits::DirtyRepr, "nothing: the same"),
            nothing("/cloud", "HdChangeTracker::DirtyExtent", Bits::DirtyExtent,
                    "nothing: the renderer bounds what it has got"),
            nothing("/cloud", "HdChangeTracker::Varying", Bits::Varying,
                    "nothing: Hydra's own note that the prim changes often"),
            {"HdChangeTracker::AllDirty", "everything; only what differs is a change", "a splat moves",
             rprim("/cloud", Bits::AllDirty, moveOne), geometry},
        }};
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
