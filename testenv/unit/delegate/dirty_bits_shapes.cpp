#include "testenv/unit/delegate/dirty_bits_rows.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

namespace {

const VtVec3fArray bent = {{-0.5f, -0.2f, 0}, {0, 0.2f, 0}, {0.5f, -0.2f, 0}},
                   straight = {{-0.5f, 0, 0}, {0, 0, 0}, {0.5f, 0, 0}};
const VtVec3fArray pair = {{-0.25f, 0, 0}, {0.25f, 0, 0}}, apart = {{-0.25f, 0, 0}, {0.25f, 0.3f, 0}};

void close(TestScene::Prim& prim, bool make) {
    prim.curves =
        HdBasisCurvesTopology(HdTokens->linear, TfToken(), make ? HdTokens->periodic : HdTokens->nonperiodic,
                              VtIntArray{3}, VtIntArray());
}

void flatten(TestScene::Prim& prim, bool make) {
    if (make) {
        prim.primvars[HdTokens->normals] = {HdInterpolationConstant, VtValue(VtVec3fArray{{0, 0, 1}})};
    } else {
        prim.primvars.erase(HdTokens->normals);
    }
}

void hide(TestScene::Prim& prim, bool make) {
    prim.visible = !make;
}

void bind(TestScene::Prim& prim, bool make) {
    prim.material = make ? SdfPath("/red") : SdfPath();
}

} // namespace

Section curvesSection() {
    const Elements geometry = {{Target::Strand, Change::Geometry}},
                   moved = {{Target::Strand, Change::Transform, 0}},
                   primvar = {{Target::Strand, Change::Primvar}};
    const auto curves = [](HdDirtyBits bits, Edit edit) { return rprim("/strand", bits, std::move(edit)); };
    const char* all = "all of the shape";
    return {
        "Basis curves",
        "An element is the object of the curves. Whatever changes of their shape, all of it is read again; "
        "instances, "
        "purpose and ids are those of a mesh.",
        {
            {"HdChangeTracker::DirtyPoints", all, "the curve becomes straight",
             curves(Bits::DirtyPoints, values("points", straight, bent)), geometry},
            {"HdChangeTracker::DirtyTopology", all, "the curve is closed", curves(Bits::DirtyTopology, close),
             geometry},
            {"HdChangeTracker::DirtyWidths", all, "the curve becomes thinner",
             curves(Bits::DirtyWidths, values("widths", VtFloatArray{0.1f}, VtFloatArray{0.2f})), geometry},
            {"HdChangeTracker::DirtyNormals", all, "normals make the tube a ribbon",
             curves(Bits::DirtyNormals, flatten), geometry},
            {"HdChangeTracker::DirtyPrimvar", all, "its colour changes",
             curves(Bits::DirtyPrimvar,
                    values("displayColor", VtVec3fArray{{0.9f, 0.1f, 0.1f}}, VtVec3fArray(1, GfVec3f(0.5f)))),
             primvar},
            {"HdChangeTracker::DirtyDisplayStyle", all, "complexity rises",
             curves(Bits::DirtyDisplayStyle,
                    [](TestScene::Prim& prim, bool make) { prim.refineLevel = make ? 1 : 0; }),
             geometry},
            {"HdChangeTracker::DirtyTransform", "the transform", "it moves",
             curves(Bits::DirtyTransform, move), moved},
            {"HdChangeTracker::DirtyVisibility",
             "visibility",
             "it hides",
             curves(Bits::DirtyVisibility, hide),
             {{Target::Strand, Change::Visibility}}},
            {"HdChangeTracker::DirtyMaterialId",
             "the binding",
             "a material is bound",
             curves(Bits::DirtyMaterialId, bind),
             {{Target::Strand, Change::Material}}},
            {"HdChangeTracker::DirtyCategories", "the collections of lights that it is in",
             "it comes into one",
             curves(Bits::DirtyCategories,
                    [](TestScene::Prim& prim, bool make) { prim.categories = categories(make); }),
             Elements{{Target::Strand, Change::Linking}}},
            {"HdChangeTracker::AllDirty", "everything; only what differs is a change", "it moves",
             curves(Bits::AllDirty, move), moved},
        }};
}

Section pointsSection() {
    const Elements second = instances(Target::Dots, Change::Transform, {1});
    Elements disks = instances(Target::Dots, Change::Transform, {0, 1});
    disks.push_back({Target::Dots, Change::Geometry});
    const auto points = [](HdDirtyBits bits, Edit edit) { return rprim("/dots", bits, std::move(edit)); };
    const char* all = "all of the shape";
    return {
        "Points",
        "An element is a point: an instance of one small geometry. Otherwise as with curves.",
        {
            {"HdChangeTracker::DirtyPoints", all, "the second point moves",
             points(Bits::DirtyPoints, values("points", apart, pair)), second},
            {"HdChangeTracker::DirtyWidths", all, "the second point grows",
             points(Bits::DirtyWidths, values("widths", VtFloatArray{0.4f, 0.5f}, VtFloatArray{0.4f, 0.4f})),
             second},
            {"HdChangeTracker::DirtyNormals", all, "normals make spheres disks",
             points(Bits::DirtyNormals, flatten), disks},
            {"HdChangeTracker::DirtyPrimvar", all, "the second point's colour changes",
             points(Bits::DirtyPrimvar,
                    values("displayColor", VtVec3fArray{GfVec3f(0.5f), {0.9f, 0.1f, 0.1f}},
                           VtVec3fArray(2, GfVec3f(0.5f)))),
             instances(Target::Dots, Change::Primvar, {1})},
            {"HdChangeTracker::DirtyTransform", "the transform", "all move",
             points(Bits::DirtyTransform, move), instances(Target::Dots, Change::Transform, {0, 1})},
            {"HdChangeTracker::DirtyVisibility",
             "visibility",
             "they hide",
             points(Bits::DirtyVisibility, hide),
             {{Target::Dots, Change::Visibility}}},
            {"HdChangeTracker::DirtyMaterialId",
             "the binding",
             "a material is bound",
             points(Bits::DirtyMaterialId, bind),
             {{Target::Dots, Change::Material}}},
        }};
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
