// Prims come, go, move, change type; composition changes below them.
#include "testenv/edit/edits.h"

namespace hipr::test {

namespace {

const std::string geo = "/World/Geo/";

Rows presence() {
    const char* const patch =
        R"(uniform token subdivisionScheme = "none"
point3f[] points = [(7.2, 0.2, 0), (7.8, 0.2, 0), (7.8, 0.8, 0), (7.2, 0.8, 0)]
int[] faceVertexCounts = [4]
int[] faceVertexIndices = [0, 1, 2, 3]
)";
    // Where Plain is, and in front of it by no distance at all: the name decides who is seen.
    const char* const square =
        R"(uniform token subdivisionScheme = "none"
point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0)]
int[] faceVertexCounts = [4]
int[] faceVertexIndices = [0, 1, 2, 3]
color3f[] primvars:displayColor = [(0, 0, 1)]
double3 xformOp:translate = (0.5, 3.5, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
)";
    return {
        {"PrimAdded", in("/World/Geo", std::string(R"(def Mesh "Patch" {)") + patch + "}")},
        {"PrimAddedBeforeTheOthers", usda(std::string(R"(def Mesh "Aaa" {)") + patch + "}")},
        {"PrimAddedInThePlaceOfAnother", in("/World/Geo", std::string(R"(def Mesh "Aaa" {)") + square + "}")},
        {"PrimAddedInThePlaceOfAnotherBehindIt",
         in("/World/Geo", std::string(R"(def Mesh "Zzz" {)") + square + "}"),
         {},
         false},
        {"PrimRenamedInThePlaceOfAnother", rename(geo + "Zzz", geo + "Aaa"),
         in("/World/Geo", std::string(R"(def Mesh "Zzz" {)") + square + "}")},
        {"PrimRemoved", removePrim(geo + "Cube")},
        {"PrimRemovedWithChildren", removePrim(geo + "Group")},
        {"PrimRemovedEverything", removePrim("/World")},
        {"PrimRenamed", rename(geo + "Cube", geo + "Zebra"), {}, false},
        {"PrimRenamedAhead", rename(geo + "Vertexed", geo + "Aardvark"), {}, false},
        {"PrimRenamedWithChildren", rename(geo + "Group", geo + "Bunch"), {}, false},
        {"PrimReparented", rename(geo + "Plain", geo + "Group/Plain")},
        {"PrimReparentedUp", rename(geo + "Group/First", "/World/First")},
        {"PrimRetypedToXform", retype(geo + "Cube", "Xform")},
        {"PrimRetypedToMesh", retype(geo + "Cube", "Mesh"), retype(geo + "Cube", "Xform")},
        {"PrimRetypedToUnknown", retype(geo + "Cube", "Wobble")},
        {"PrimRetypedToSphere", retype(geo + "Cube", "Sphere")},
        {"PrimRetypedToScope", retype(geo + "Group", "Scope")},
        {"PrimInactive", activate(geo + "Round", false)},
        {"PrimActiveAgain", activate(geo + "Round", true), activate(geo + "Round", false)},
        {"PrimInactiveParent", activate(geo + "Group", false)},
        {"PrimUndefined",
         usda(R"(over "World" { over "Geo" { over "Nothing" { bool doubleSided = true
} } })"),
         {},
         false},
        {"PrimImplicitSphere", in("/World/Geo", R"(def Sphere "Ball" { double radius = 0.3
double3 xformOp:translate = (7.5, 0.5, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
})")},
        {"PrimImplicitSphereRadius", in("/World/Geo/Ball", "double radius = 0.45"),
         in("/World/Geo", R"(def Sphere "Ball" { double radius = 0.3
double3 xformOp:translate = (7.5, 0.5, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
})")},
    };
}

Rows places() {
    return {
        {"Transform", in(geo + "Cube", "double3 xformOp:translate = (1.4, 3.6, 0.2)")},
        {"TransformRotation", in(geo + "Cube", "float3 xformOp:rotateXYZ = (70, 10, 5)")},
        {"TransformOrder",
         in(geo + "Cube", R"(uniform token[] xformOpOrder = ["xformOp:rotateXYZ", "xformOp:translate"])")},
        {"TransformAdded", in("/World/Wall", R"(double3 xformOp:translate = (0, 0, -0.5)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
        {"TransformRemoved", removeProperty(geo + "Plain.xformOpOrder")},
        {"TransformMirrored", in(geo + "Round", "float3 xformOp:scale = (-1.4, 1, 1)")},
        {"TransformOfAncestor", in(geo + "Group", "double3 xformOp:translate = (4.4, 0.7, 0.2)")},
        {"TransformOfTheWorld", in("/World", R"(double3 xformOp:translate = (0.2, 0.1, 0)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
        {"TransformReset", in(geo + "Group/First", R"(double3 xformOp:translate = (7.5, 0.5, 0)
uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate"])")},
        {"TransformResetGone",
         in(geo + "Group/First", R"(uniform token[] xformOpOrder = ["xformOp:translate"])"),
         in(geo + "Group/First", R"(double3 xformOp:translate = (-0.2, 0.1, 0)
uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate"])")},
        {"TransformSingular", in(geo + "Round", "float3 xformOp:scale = (0, 1, 1)")},
        {"TransformFromSingular", in(geo + "Round", "float3 xformOp:scale = (1, 1, 1)"),
         in(geo + "Round", "float3 xformOp:scale = (0, 1, 1)")},
        {"VisibilityOff", in(geo + "Cube", R"(token visibility = "invisible")")},
        {"VisibilityOn", in(geo + "Cube", R"(token visibility = "inherited")"),
         in(geo + "Cube", R"(token visibility = "invisible")")},
        {"VisibilityOfAncestor", in("/World/Geo", R"(token visibility = "invisible")")},
        {"VisibilityOfAncestorBack", in("/World/Geo", R"(token visibility = "inherited")"),
         in("/World/Geo", R"(token visibility = "invisible")")},
        {"VisibilityOfTheWorld", in("/World", R"(token visibility = "invisible")")},
        {"EditsWhileHidden", in(geo + "Cube", R"(token visibility = "inherited")"),
         in(geo + "Cube",
            R"(token visibility = "invisible"
int[] holeIndices = [1]
double3 xformOp:translate = (1.4, 3.6, 0.2))")},
        {"PurposeToProxy", in(geo + "Cube", R"(uniform token purpose = "proxy")")},
        {"PurposeToDefault", in(geo + "Proxy", R"(uniform token purpose = "default")")},
        {"PurposeToGuide", in(geo + "Render", R"(uniform token purpose = "guide")")},
        {"PurposeOfAncestor", in(geo + "Group", R"(uniform token purpose = "proxy")")},
    };
}

Rows composition() {
    return {
        {"PayloadUnloaded", load(geo + "Payload", false)},
        {"PayloadLoaded", load(geo + "Payload", true), load(geo + "Payload", false)},
        {"PayloadEdited", in(geo + "Payload/Disc", "color3f[] primvars:displayColor = [(0.9, 0.9, 0.9)]")},
        {"PayloadRemoved", usda(R"(over "World" { over "Geo" { over "Payload" (payload = None) {} } })")},
        {"ReferenceAdded",
         usda(
             R"(over "World" { over "Geo" { def "Again" (references = @./payload.usda@) { double3 xformOp:translate = (7.5, 0.5, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
} } })")},
        {"InheritAdded",
         usda(
             R"(over "World" { over "Geo" { def Xform "Heir" (inherits = </_Pair>) { double3 xformOp:translate = (7.5, 0.5, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
} } })")},
        {"InheritedClassEdited", in("/_Pair", "double3 xformOp:scale = (0.5, 1, 1)"), {}, false},
        {"VariantShape", select(geo + "Choice", "shape", "triangle")},
        {"VariantShapeNothing", select(geo + "Choice", "shape", "nothing")},
        {"VariantShapeBack", select(geo + "Choice", "shape", "square"),
         select(geo + "Choice", "shape", "nothing")},
        {"VariantLook", select(geo + "Choice", "look", "green")},
        {"VariantBoth",
         all({select(geo + "Choice", "look", "green"), select(geo + "Choice", "shape", "triangle")})},
        {"LayerMuted", mute("extra.usda")},
        {"LayerUnmuted", unmute("extra.usda"), mute("extra.usda")},
        {"LayerMutedLights", mute("lights.usda")},
        {"LayerMutedLooks", mute("looks.usda")},
        {"LayerMutedInstances", mute("instances.usda")},
        {"LayerMutedGeometry", mute("geometry.usda")},
        {"LayerUnmutedGeometry", unmute("geometry.usda"), mute("geometry.usda")},
        {"LayerOffset",
         [](Scene& scene) {
             scene.stage()->GetRootLayer()->SetSubLayerOffset(PXR_NS::SdfLayerOffset(-5, 1), 1);
         }},
        {"LayerRemoved", [](Scene& scene) { scene.stage()->GetRootLayer()->RemoveSubLayerPath(0); }},
        {"StageSwapped", [](Scene& scene) { scene.swapStage(); }, {}, false},
        {"StageSwappedAfterEdits", [](Scene& scene) { scene.swapStage(); },
         all({removePrim(geo + "Cube"), rename(geo + "Group", geo + "Bunch")}), false},
    };
}

} // namespace

Rows hierarchyRows() {
    Rows rows = presence();
    for (const Rows& more : {places(), composition()})
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
