// Point instancers, nested ones, and native instances.
#include "testenv/edit/edits.h"

namespace hipr::test {

namespace {

const std::string inst = "/World/Inst/", cloud = inst + "Cloud";
const char* const fewer = R"(int64[] ids = [10, 12]
point3f[] positions = [(-0.6, -0.2, 0), (0.2, -0.2, 0)]
quath[] orientations = [(1, 0, 0, 0), (1, 0, 0, 0)]
float3[] scales = [(1, 1, 1), (1, 0.6, 1)]
int[] protoIndices = [0, 0]
color3f[] primvars:displayColor = [(0.9, 0.1, 0.1), (0.1, 0.1, 0.9)])";
const char* const more = R"(int64[] ids = [10, 11, 12, 13, 14]
point3f[] positions = [(-0.6, -0.2, 0), (-0.2, 0.2, 0), (0.2, -0.2, 0), (0.6, 0.2, 0), (0, 0, 0.2)]
quath[] orientations = [(1, 0, 0, 0), (0.92, 0, 0, 0.38), (1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)]
float3[] scales = [(1, 1, 1), (1.2, 1.2, 1), (1, 0.6, 1), (1, 1, 1), (1, 1, 1)]
int[] protoIndices = [0, 1, 0, 1, 0]
color3f[] primvars:displayColor = [(0.9, 0.1, 0.1), (0.1, 0.9, 0.1), (0.1, 0.1, 0.9), (0.9, 0.9, 0.1), (1, 1, 1)])";

Rows points() {
    return {
        {"PointsMove",
         in(cloud,
            "point3f[] positions = [(-0.7, -0.2, 0), (-0.2, 0.1, 0), (0.2, -0.1, 0), (0.6, 0.2, 0.3)]")},
        {"PointsTurn", in(cloud, "quath[] orientations = [(0.92, 0, 0, 0.38), (0.92, 0, 0, 0.38), (1, 0, 0, "
                                 "0), (0.7, 0, 0, 0.7)]")},
        {"PointsTurnNot", removeProperty(cloud + ".orientations")},
        {"PointsScale",
         in(cloud, "float3[] scales = [(0.5, 0.5, 1), (1.5, 1.2, 1), (1, 1.6, 1), (1, 0.3, 1)]")},
        {"PointsScaleNot", removeProperty(cloud + ".scales")},
        {"PointsScaleZero",
         in(cloud, "float3[] scales = [(0, 0, 0), (1.2, 1.2, 1), (1, 0.6, 1), (1, 1, 1)]")},
        {"PointsScaleFromZero",
         in(cloud, "float3[] scales = [(1, 1, 1), (1.2, 1.2, 1), (1, 0.6, 1), (1, 1, 1)]"),
         in(cloud, "float3[] scales = [(0, 0, 0), (1.2, 1.2, 1), (1, 0.6, 1), (1, 1, 1)]")},
        {"PointsNotANumber",
         in(cloud, "point3f[] positions = [(nan, -0.2, 0), (-0.2, 0.2, 0), (0.2, -0.2, 0), (0.6, 0.2, 0)]")},
        {"PointsProtoIndices", in(cloud, "int[] protoIndices = [1, 1, 0, 0]")},
        {"PointsOneProtoUnused", in(cloud, "int[] protoIndices = [0, 0, 0, 0]")},
        {"PointsOneProtoUsedAgain", in(cloud, "int[] protoIndices = [0, 0, 0, 1]"),
         in(cloud, "int[] protoIndices = [0, 0, 0, 0]")},
        {"PointsFewer", in(cloud, fewer)},
        {"PointsMore", in(cloud, more)},
        {"PointsNoneLeft", in(cloud, R"(int64[] ids = []
point3f[] positions = []
quath[] orientations = []
float3[] scales = []
int[] protoIndices = [])")},
        {"PointsTooFewPositions", in(cloud, "point3f[] positions = [(-0.6, -0.2, 0)]")},
        {"PointsIds", in(cloud, "int64[] ids = [10, 11, 99, 13]"), in(cloud, "int64[] invisibleIds = [12]")},
        {"PointsInvisibleIds", in(cloud, "int64[] invisibleIds = [11, 12]")},
        {"PointsInvisibleIdsChange", in(cloud, "int64[] invisibleIds = [10]"),
         in(cloud, "int64[] invisibleIds = [11, 12]")},
        {"PointsInvisibleIdsGone", in(cloud, "int64[] invisibleIds = []"),
         in(cloud, "int64[] invisibleIds = [11, 12]")},
        {"PointsInactiveIds",
         usda(R"(over "World" { over "Inst" { over "Cloud" (inactiveIds = [10]) {} } })")},
        {"PointsColor", in(cloud, "color3f[] primvars:displayColor = [(0.1, 0.1, 0.1), (0.1, 0.9, 0.1), "
                                  "(0.9, 0.9, 0.9), (0.9, 0.9, 0.1)]")},
        {"PointsColorTooShort",
         in(cloud, "color3f[] primvars:displayColor = [(0.1, 0.1, 0.1), (0.1, 0.9, 0.1)]")},
        {"PointsColorGone", removeProperty(cloud + ".primvars:displayColor")},
        {"PointsColorBack",
         in(cloud,
            R"(color3f[] primvars:displayColor = [(0.2, 0.1, 0.1), (0.1, 0.9, 0.1), (0.9, 0.9, 0.9), (0.9, 0.9, 0.1)] (interpolation = "vertex"))"),
         removeProperty(cloud + ".primvars:displayColor")},
        {"PointsOpacity",
         in(cloud, R"(float[] primvars:displayOpacity = [0.5, 1, 0.2, 1] (interpolation = "vertex"))")},
        {"PointsInstancerMoves", in(cloud, "double3 xformOp:translate = (3.1, 1.4, 0.2)")},
        {"PointsInstancerHidden", in(cloud, R"(token visibility = "invisible")")},
        {"PointsInstancerShown", in(cloud, R"(token visibility = "inherited")"),
         in(cloud, R"(token visibility = "invisible")")},
        {"PointsInstancerRemoved", removePrim(cloud)},
        {"PointsInstancerInactive", activate(cloud, false)},
        {"PointsInstancerRenamed", rename(cloud, inst + "Swarm"), {}, false},
    };
}

Rows prototypes() {
    const char* const dot =
        R"(def Mesh "Dot" {
uniform token subdivisionScheme = "none"
point3f[] points = [(-0.1, -0.1, 0), (0.1, -0.1, 0), (0, 0.1, 0)]
int[] faceVertexCounts = [3]
int[] faceVertexIndices = [0, 1, 2]
}
rel prototypes = [</World/Inst/Cloud/Square>, </World/Inst/Cloud/Dot>])";
    return {
        {"PrototypePoints",
         in(cloud + "/Square",
            "point3f[] points = [(-0.1, -0.3, 0), (0.1, -0.3, 0), (0.1, 0.3, 0), (-0.1, 0.3, 0)]")},
        {"PrototypeTopology", in(cloud + "/Kite/Shape", R"(int[] faceVertexCounts = [3]
int[] faceVertexIndices = [0, 1, 2])")},
        {"PrototypeBinding", in(cloud + "/Kite/Shape", "rel material:binding = </World/Looks/Green>")},
        {"PrototypeTransform", in(cloud + "/Square", R"(double3 xformOp:translate = (0.1, 0.1, 0)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
        {"PrototypeHidden", in(cloud + "/Square", R"(token visibility = "invisible")")},
        {"PrototypeRemoved", removePrim(cloud + "/Kite")},
        {"PrototypeRemovedPart", removePrim(cloud + "/Kite/Shape")},
        {"PrototypeInactive", activate(cloud + "/Square", false)},
        {"PrototypeAddedPart", in(cloud + "/Kite", R"(def Mesh "More" {
uniform token subdivisionScheme = "none"
point3f[] points = [(-0.1, -0.1, 0.2), (0.1, -0.1, 0.2), (0, 0.1, 0.2)]
int[] faceVertexCounts = [3]
int[] faceVertexIndices = [0, 1, 2]
})")},
        {"PrototypesSwapped",
         in(cloud, "rel prototypes = [</World/Inst/Cloud/Kite>, </World/Inst/Cloud/Square>]")},
        {"PrototypesOther", in(cloud, dot)},
        {"NestedOuterMoves", in(inst + "Outer", "point3f[] positions = [(-0.5, 0.1, 0), (0.3, 0, 0)]")},
        {"NestedInnerMoves",
         in(inst + "Outer/Inner", "point3f[] positions = [(0, -0.35, 0), (0.1, 0.25, 0)]")},
        {"NestedOuterMore",
         in(inst + "Outer", R"(point3f[] positions = [(-0.5, 0.1, 0), (0.3, 0, 0), (0, 0, 0.2)]
int[] protoIndices = [0, 0, 0])")},
        {"NestedInnerFewer", in(inst + "Outer/Inner", R"(point3f[] positions = [(0, -0.35, 0)]
int[] protoIndices = [0])")},
        {"NestedOuterInvisibleIds", in(inst + "Outer", "int64[] invisibleIds = [1]")},
        {"NestedInnerInvisibleIds", in(inst + "Outer/Inner", "int64[] invisibleIds = [0]")},
        {"NestedInnerTransform",
         in(inst + "Outer/Inner", R"(double3 xformOp:translate = (0.1, 0, 0.1)
uniform token[] xformOpOrder = ["xformOp:translate"])"),
         {},
         false},
        {"NestedOuterTransform", in(inst + "Outer", "double3 xformOp:translate = (5.1, 1.6, 0)")},
        {"NestedChipPoints",
         in(inst + "Outer/Inner/Chip",
            "point3f[] points = [(-0.1, -0.2, 0), (0.3, -0.2, 0), (0.3, 0.2, 0), (-0.1, 0.2, 0)]")},
        {"NestedInnerColor",
         in(inst + "Outer/Inner",
            R"(color3f[] primvars:displayColor = [(0.9, 0, 0), (0, 0, 0.9)] (interpolation = "vertex"))")},
        {"NestedOuterColor",
         in(inst + "Outer",
            R"(color3f[] primvars:displayColor = [(0.9, 0, 0), (0, 0, 0.9)] (interpolation = "vertex"))")},
        {"NestedInnerRemoved", removePrim(inst + "Outer/Inner")},
    };
}

/// Why some rows are skipped.
const char* const noResync = "it does not resync the parts of a native prototype";

Rows natives() {
    return {
        {"NativeMoves", in(inst + "A", "double3 xformOp:translate = (0.6, 1.4, 0.1)")},
        {"NativeHidden", in(inst + "A", R"(token visibility = "invisible")")},
        {"NativeShown", in(inst + "A", R"(token visibility = "inherited")"),
         in(inst + "A", R"(token visibility = "invisible")")},
        {"NativeRemovedFirst",
         removePrim(inst + "A"),
         {},
         true,
         "",
         "it names prototypes after the instance that it met first"},
        {"NativeRemovedLast", removePrim(inst + "B")},
        {"NativeRemovedAll", all({removePrim(inst + "A"), removePrim(inst + "B")})},
        {"NativeInactive", activate(inst + "B", false)},
        {"NativeAdded", in("/World/Inst", R"(def Xform "C" (
inherits = </_Pair>
instanceable = true
) {
double3 xformOp:translate = (7.5, 1.5, 0)
uniform token[] xformOpOrder = ["xformOp:translate"]
})")},
        {"NativeInstanceableOff",
         usda(R"(over "World" { over "Inst" { over "A" (instanceable = false) {} } })"),
         {},
         true,
         "",
         "it names prototypes after the instance that it met first"},
        {"NativeInstanceableOn",
         usda(R"(over "World" { over "Inst" { over "Loose" (instanceable = true) {} } })")},
        {"NativeInstanceableOffAll", usda(R"(over "World" { over "Inst" { over "A" (instanceable = false) {}
over "B" (instanceable = false) {} } })")},
        {"NativePrototypePoints",
         in("/_Pair/Left",
            "point3f[] points = [(-0.25, -0.3, 0), (-0.05, -0.3, 0), (-0.05, 0.1, 0), (-0.35, 0.3, 0)]")},
        {"NativePrototypePart",
         in("/_Pair", R"(def Mesh "Middle" {
uniform token subdivisionScheme = "none"
point3f[] points = [(-0.1, -0.1, 0.2), (0.1, -0.1, 0.2), (0, 0.1, 0.2)]
int[] faceVertexCounts = [3]
int[] faceVertexIndices = [0, 1, 2]
})"),
         {},
         true,
         noResync},
        {"NativePrototypePartRemoved", removePrim("/_Pair/Right"), {}, true, noResync},
        {"NativeRenamed",
         all({removePrim(inst + "B"), in("/World/Inst", R"(def Xform "D" (
inherits = </_Pair>
instanceable = true
) {
double3 xformOp:translate = (1.5, 1.5, 0)
float xformOp:rotateZ = 30
uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]
})")}),
         {},
         false},
        {"NativeColor",
         in(inst + "B",
            R"(color3f[] primvars:displayColor = [(0.9, 0.1, 0.5)] (interpolation = "constant"))"),
         {},
         true,
         "it does not regroup native instances"},
        {"NativeBinding",
         in(inst + "B",
            R"(rel material:binding = </World/Looks/Lamp> (bindMaterialAs = "strongerThanDescendants"))")},
        {"NativeParentMoves", in("/World/Inst", R"(double3 xformOp:translate = (0.1, 0.1, 0)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
    };
}

} // namespace

Rows instanceRows() {
    Rows rows = points();
    for (Row& row : rows)
        row.name = "Instancer" + row.name;
    for (const Rows& other : {prototypes(), natives()})
        rows.insert(rows.end(), other.begin(), other.end());
    return rows;
}

} // namespace hipr::test
