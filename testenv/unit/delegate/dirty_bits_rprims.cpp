#include "pxr/imaging/pxOsd/tokens.h"
#include "testenv/unit/delegate/dirty_bits_rows.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

namespace {

const Elements geometry = {{Target::Square, Change::Geometry}}, primvar = {{Target::Square, Change::Primvar}},
               moved = {{Target::Square, Change::Transform, 0}},
               visibility = {{Target::Square, Change::Visibility}},
               smoothGeometry = {{Target::Smooth, Change::Geometry}},
               oneGone = instances(Target::Many, Change::Removed, {1}),
               oneBack = instances(Target::Many, Change::Added, {1});

const VtVec3fArray square = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.5f, 0.5f, 0}, {-0.5f, 0.5f, 0}},
                   kite = {{-0.5f, -0.5f, 0}, {0.5f, -0.5f, 0}, {0.9f, 0.9f, 0}, {-0.5f, 0.5f, 0}};

HdMeshTopology faces(VtIntArray const& counts, VtIntArray const& indices) {
    return HdMeshTopology(PxOsdOpenSubdivTokens->none, PxOsdOpenSubdivTokens->rightHanded, counts, indices);
}

void cut(TestScene::Prim& prim, bool make) {
    prim.topology = make ? faces({3}, {0, 1, 2}) : faces({4}, {0, 1, 2, 3});
}

void bindSubset(TestScene::Prim& prim, bool make) {
    HdGeomSubset subset;
    subset.type = HdGeomSubset::TypeFaceSet;
    subset.id = SdfPath("/square/subset");
    subset.materialId = SdfPath("/green");
    subset.indices = {0};
    prim.topology.SetGeomSubsets(make ? HdGeomSubsets{subset} : HdGeomSubsets());
}

void refine(TestScene::Prim& prim, bool make) {
    prim.refineLevel = make ? 3 : 2;
}

void roundCorners(TestScene::Prim& prim, bool make) {
    prim.tags.SetVertexInterpolationRule(make ? PxOsdOpenSubdivTokens->edgeOnly
                                              : PxOsdOpenSubdivTokens->edgeAndCorner);
}

void showHull(TestScene::Prim& prim, bool make) {
    prim.repr = make ? HdReprSelector(HdReprTokens->smoothHull) : HdReprSelector();
}

/// A mesh that moved while it was hidden, and is shown.
void showElsewhere(TestScene::Prim& prim, bool make) {
    prim.visible = make;
    move(prim, make);
}

void tag(TestScene::Prim& prim, bool make) {
    prim.renderTag = make ? HdRenderTagTokens->guide : HdRenderTagTokens->geometry;
}

void bind(TestScene::Prim& prim, bool make) {
    prim.material = SdfPath(make ? "/green" : "/red");
}

void hideSecond(TestScene::Prim& prim, bool make) {
    prim.indices[SdfPath("/many.square")] = make ? VtIntArray{0, 2} : VtIntArray{0, 1, 2};
}

void appendFourth(TestScene::Prim& prim, bool make) {
    prim.indices[SdfPath("/many.square")] = make ? VtIntArray{0, 1, 2, 3} : VtIntArray{0, 1, 2};
}

Edit translations(VtVec3fArray made, VtVec3fArray undone) {
    return values("translate", std::move(made), std::move(undone));
}

const Edit moveSecond = translations({{-2, 2, 0}, {0.5f, 2, 0}, {2, 2, 0}, {3, 2, 0}},
                                     {{-2, 2, 0}, {0, 2, 0}, {2, 2, 0}, {3, 2, 0}});

void addPrimvar(TestScene::Prim& prim, bool make) {
    if (make) {
        prim.primvars[TfToken("wear")] = {HdInterpolationInstance, VtValue(VtFloatArray(4, 0.5f))};
    } else {
        prim.primvars.erase(TfToken("wear"));
    }
}

/// What an instancer's children are asked for; the mesh is marked, the edit is the instancer's.
Apply manySquare(HdDirtyBits bits, Edit edit) {
    return [=](World& world, bool make) {
        edit(world.prim("/many"), make);
        world.tracker().MarkRprimDirty(SdfPath("/many.square"), bits);
    };
}

void computeElsewhere(World& world, bool make) {
    world.prim("/computation").params[TfToken("offset")] = VtValue(GfVec3f(0, make ? 0.5f : 0.f, 0));
    world.tracker().MarkRprimDirty(SdfPath("/computed"), Bits::DirtyComputationPrimvarDesc);
}

const HdDirtyBits custom = HdDirtyBits(Bits::CustomBitsBegin) | HdDirtyBits(Bits::CustomBitsEnd);

std::vector<Row> shapeRows() {
    const VtVec3fArray straight(4, GfVec3f(0, 0, 1)), tilted(4, GfVec3f(0.6f, 0, 0.8f));
    return {
        {"HdChangeTracker::DirtyPoints", "the points; other primvars stay", "a point moves",
         rprim("/square", Bits::DirtyPoints, values("points", kite, square)), geometry},
        {"HdChangeTracker::DirtyTopology",
         "topology, GeomSubsets, subdivision tags; Hydra adds points, normals and primvars",
         "the square becomes a triangle", rprim("/square", Bits::DirtyTopology, cut), geometry},
        {"HdChangeTracker::DirtyTopology",
         "the same",
         "a GeomSubset gets a material of its own",
         rprim("/square", Bits::DirtyTopology, bindSubset),
         {{Target::Square, Change::Primvar | Change::Material}}},
        {"HdChangeTracker::DirtySubdivTags", "subdivision tags, where there is a scheme",
         "corners become round", rprim("/smooth", Bits::DirtySubdivTags, roundCorners), smoothGeometry},
        {"HdChangeTracker::DirtyDisplayStyle",
         "refine level and flat shading; Hydra adds the topology and all primvars",
         "a subdivided mesh is refined further", rprim("/smooth", Bits::DirtyDisplayStyle, refine),
         smoothGeometry},
        {"HdChangeTracker::DirtyDisplayStyle",
         "the same",
         "the refine level of polygons, which have none",
         rprim("/square", Bits::DirtyDisplayStyle, refine),
         {}},
        {"HdChangeTracker::DirtyRepr", "the repr (hull or refined)", "a prim asks for its hull",
         rprim("/smooth", Bits::DirtyRepr, showHull), smoothGeometry},
        {"HdChangeTracker::NewRepr",
         "the display style; set by the mesh itself for a repr it has not had",
         "",
         rprim("/smooth", Bits::NewRepr),
         {}},
        {"HdChangeTracker::InitRepr",
         "nothing: Hydra asks for reprs itself",
         "",
         rprim("/smooth", Bits::InitRepr),
         {}},
        {"HdChangeTracker::DirtyNormals", "the normals", "the normals tilt",
         rprim("/square", Bits::DirtyNormals, values("normals", tilted, straight)), primvar},
        {"HdChangeTracker::DirtyPrimvar", "all primvars that have no bit of their own",
         "`displayColor` changes",
         rprim("/square", Bits::DirtyPrimvar,
               values("displayColor", VtVec3fArray{GfVec3f(0.1f)}, VtVec3fArray{GfVec3f(0.5f)})),
         primvar},
        {"HdChangeTracker::DirtyWidths",
         "a primvar `widths`, which materials may read; a mesh has no other use for it", "`widths` change",
         rprim("/square", Bits::DirtyWidths, values("widths", VtFloatArray(4, 2.f), VtFloatArray(4, 1.f))),
         primvar},
        {"HdChangeTracker::DirtyComputationPrimvarDesc",
         "computed primvars, and with them all others",
         "the input of a computation changes",
         computeElsewhere,
         {{Target::Computed, Change::Geometry}}},
        {"HdChangeTracker::DirtyDoubleSided",
         "the flag, which is kept with the mesh and says what some cull styles cull",
         "a mesh becomes single-sided",
         rprim("/square", Bits::DirtyDoubleSided,
               [](TestScene::Prim& prim, bool make) { prim.doubleSided = !make; }),
         primvar},
        {"HdChangeTracker::DirtyCullStyle",
         "the sides of faces that the camera sees",
         "front faces are culled",
         rprim("/square", Bits::DirtyCullStyle,
               [](TestScene::Prim& prim, bool make) {
                   prim.cullStyle = make ? HdCullStyleFront : HdCullStyleDontCare;
               }),
         {{Target::Square, Change::Visibility}}},
        {"HdChangeTracker::DirtyExtent",
         "nothing: the renderer bounds what it has got",
         "",
         rprim("/square", Bits::DirtyExtent),
         {}},
        {"HdChangeTracker::DirtyVolumeField",
         "nothing: a mesh has no fields",
         "",
         rprim("/square", Bits::DirtyVolumeField),
         {}},
    };
}

std::vector<Row> placeRows() {
    return {
        {"HdChangeTracker::DirtyTransform", "the transform", "it moves",
         rprim("/square", Bits::DirtyTransform, move), moved},
        {"HdChangeTracker::DirtyTransform", "transform and instances", "the prototype of an instancer moves",
         rprim("/many.square", Bits::DirtyTransform, move),
         instances(Target::Many, Change::Transform, {0, 1, 2})},
        {"HdChangeTracker::DirtyTransform",
         "nothing before it is shown: Hydra does not sync what is hidden",
         "a hidden mesh moves",
         rprim("/hidden", Bits::DirtyTransform, move),
         {}},
        {"HdChangeTracker::DirtyVisibility",
         "visibility, and what else was marked while it was hidden",
         "a hidden mesh that has moved is shown",
         rprim("/hidden", Bits::DirtyVisibility | Bits::DirtyTransform, showElsewhere),
         {{Target::Hidden, Change::Visibility}, {Target::Hidden, Change::Transform, 0}}},
        {"HdChangeTracker::DirtyInstancer",
         "transform and instances; Hydra marks it with every change of an instancer above",
         "one instance is hidden", manySquare(Bits::DirtyInstancer, hideSecond), oneGone, oneBack},
        {"HdChangeTracker::DirtyInstanceIndex", "transform and instances", "one instance is hidden",
         manySquare(Bits::DirtyInstanceIndex, hideSecond), oneGone, oneBack},
        {"HdChangeTracker::DirtyVisibility", "visibility", "it hides",
         rprim("/square", Bits::DirtyVisibility,
               [](TestScene::Prim& prim, bool make) { prim.visible = !make; }),
         visibility},
        {"HdChangeTracker::DirtyRenderTag", "the render tag; the render pass tells which are seen",
         "its purpose becomes guide", rprim("/square", Bits::DirtyRenderTag, tag), visibility},
        {"HdChangeTracker::DirtyMaterialId",
         "the binding",
         "another material is bound",
         rprim("/square", Bits::DirtyMaterialId, bind),
         {{Target::Square, Change::Material}}},
        {"HdChangeTracker::DirtyPrimID", "the prim id, for the AOV", "Hydra gives out ids anew",
         setPrimId("/square", 1234), primvar},
        {"HdChangeTracker::DirtyCategories",
         "the collections of lights that it is in",
         "it comes into one",
         rprim("/square", Bits::DirtyCategories,
               [](TestScene::Prim& prim, bool make) { prim.categories = categories(make); }),
         {{Target::Square, Change::Linking}}},
        {"HdChangeTracker::DirtyCategories", "the same, and those of its instances",
         "one instance comes into one",
         [](World& world, bool make) {
             world.prim("/many").instanceCategories = {{}, categories(make), {}, {}};
             world.tracker().MarkRprimDirty(SdfPath("/many.square"), Bits::DirtyCategories);
         },
         instances(Target::Many, Change::Linking, {1})},
        {"HdChangeTracker::Clean", "nothing; Hydra refuses to mark it", "", [](World&, bool) {}, {}},
        {"HdChangeTracker::Varying",
         "nothing: Hydra's own note that the prim changes often",
         "",
         rprim("/square", Bits::Varying),
         {}},
        {"HdChangeTracker::AllDirty", "everything; only what differs is a change", "it moves",
         rprim("/square", Bits::AllDirty, move), moved},
        {"HdChangeTracker::AllSceneDirtyBits", "everything; only what differs is a change", "it moves",
         rprim("/square", Bits::AllSceneDirtyBits, move), moved},
        {"HdChangeTracker::CustomBitsBegin",
         "nothing: HiPR has no bits of its own",
         "",
         rprim("/square", custom),
         {}},
        {"HdChangeTracker::CustomBitsEnd", "nothing: the same", "", rprim("/square", custom), {}},
    };
}

} // namespace

Section meshSection() {
    Section section{"Mesh",
                    "An element is the object of the mesh; `instance` is the index of one of its instances, "
                    "0 where there is no instancer.",
                    shapeRows()};
    for (Row& row : placeRows()) {
        section.rows.push_back(std::move(row));
    }
    return section;
}

Section instancerSection() {
    const VtVec3fArray grey(4, GfVec3f(0.5f));
    VtVec3fArray oneRed = grey;
    oneRed[2] = GfVec3f(0.8f, 0, 0);
    const Elements all = instances(Target::Many, Change::Transform, {0, 1, 2});
    return {
        "Instancer",
        "An instancer is no element itself: Hydra marks DirtyInstancer on the meshes below it, they read "
        "their instances again, and those that differ are named. Instances that come or go leave the others "
        "alone.",
        {
            {"HdChangeTracker::DirtyPrimvar", "the instance primvars; each mesh below reads its instances",
             "the second instance moves", instancer("/many", Bits::DirtyPrimvar, moveSecond),
             instances(Target::Many, Change::Transform, {1})},
            {"HdChangeTracker::DirtyPrimvar", "the same", "`displayColor` of the third instance changes",
             instancer("/many", Bits::DirtyPrimvar, values("displayColor", oneRed, grey)),
             instances(Target::Many, Change::Primvar, {2})},
            {"HdChangeTracker::DirtyPrimvar",
             "the same",
             "all instances get a new primvar",
             instancer("/many", Bits::DirtyPrimvar, addPrimvar),
             {{Target::Many, Change::Primvar}}},
            {"HdChangeTracker::DirtyPrimvar", "the same, through all levels",
             "an outer instance moves that holds two inner ones",
             instancer("/outer", Bits::DirtyPrimvar,
                       translations({{-1, 0, 0}, {1.5f, 0, 0}}, {{-1, 0, 0}, {1, 0, 0}})),
             instances(Target::Nested, Change::Transform, {2, 3})},
            {"HdChangeTracker::DirtyInstanceIndex", "which instances there are; each mesh below reads them",
             "the second instance is hidden", instancer("/many", Bits::DirtyInstanceIndex, hideSecond),
             oneGone, oneBack},
            {"HdChangeTracker::DirtyInstanceIndex", "the same", "a fourth instance comes",
             instancer("/many", Bits::DirtyInstanceIndex, appendFourth),
             instances(Target::Many, Change::Added, {3}), instances(Target::Many, Change::Removed, {3})},
            {"HdChangeTracker::DirtyTransform", "its transform, by each mesh below", "the instancer moves",
             instancer("/many", Bits::DirtyTransform, move), all},
            {"HdChangeTracker::DirtyInstancer",
             "nothing of its own; each mesh below reads its instances",
             "",
             instancer("/many", Bits::DirtyInstancer),
             {}},
            {"HdChangeTracker::AllDirty", "everything; only what differs is a change",
             "the second instance moves", instancer("/many", Bits::AllDirty, moveSecond),
             instances(Target::Many, Change::Transform, {1})},
        }};
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
