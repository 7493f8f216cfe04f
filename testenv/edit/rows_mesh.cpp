// Shape: points, topology, subdivision, orientation, subsets.
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/vt/array.h"
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

const std::string geo = "/World/Geo/";

/// A triangle where a square was.
const char* const triangle = R"(int[] faceVertexCounts = [3]
int[] faceVertexIndices = [0, 1, 2])";
const char* const biggerPlain =
    R"(point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0), (0, 0.45, 0.3)]
int[] faceVertexCounts = [5]
int[] faceVertexIndices = [0, 1, 2, 4, 3])";

Rows shapes() {
    return {
        {"Points",
         in(geo + "Plain",
            "point3f[] points = [(-0.2, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.3, 0.2), (-0.4, 0.4, 0)]")},
        {"PointsInTheirOwnLayer",
         set(geo + "Plain.points", VtValue(VtVec3fArray{GfVec3f(-0.3f, -0.4f, 0), GfVec3f(0.3f, -0.4f, 0),
                                                        GfVec3f(0.3f, 0.4f, 0), GfVec3f(-0.3f, 0.4f, 0)}))},
        {"PointsOfASubdivided",
         in(geo + "Round",
            "point3f[] points = [(-0.3, -0.3, -0.3), (0.3, -0.3, -0.3), (0.3, 0.3, -0.3), (-0.3, 0.3, -0.3), "
            "(-0.3, -0.3, 0.3), (0.1, -0.1, 0.3), (0.3, 0.3, 0.5), (-0.3, 0.1, 0.3)]")},
        {"PointsWithNormals",
         in(geo + "Smooth", "point3f[] points = [(-0.4, -0.4, 0), (0, -0.4, 0), (0.4, -0.2, 0), (-0.4, 0, "
                            "0), (0, 0, 0.5), (0.4, 0, 0), (-0.4, 0.4, 0), (0, 0.4, 0), (0.4, 0.2, 0)]")},
        {"PointsMakeAQuadConcave",
         in(geo + "Plain",
            "point3f[] points = [(-0.4, -0.4, 0), (-0.1, 0.1, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0)]")},
        {"PointsTooFew",
         in(geo + "Plain", "point3f[] points = [(-0.2, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.3, 0)]")},
        {"PointsNone", in(geo + "Plain", "point3f[] points = []")},
        {"PointsRemoved", removeProperty(geo + "Plain.points")},
        {"PointsAfterNone",
         in(geo + "Plain",
            "point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0)]"),
         in(geo + "Plain", "point3f[] points = []")},
        {"PointsNotANumber",
         in(geo + "Plain",
            "point3f[] points = [(nan, -0.4, 0), (0.4, -0.4, 0), (0.4, 0.4, 0), (-0.4, 0.4, 0)]")},
        {"PointsSame",
         in(geo + "Plain",
            "point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (-0.4, 0.4, 0), (0.4, 0.4, 0)]"),
         in(geo + "Plain",
            "point3f[] points = [(-0.4, -0.4, 0), (0.4, -0.4, 0), (-0.4, 0.4, 0), (0.4, 0.4, 0)]"),
         false},
        {"TopologyTriangle", in(geo + "Plain", triangle)},
        {"TopologyOfAnIndexed", in(geo + "Indexed", R"(int[] faceVertexCounts = [4, 4, 4]
int[] faceVertexIndices = [0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6])")},
        {"TopologyAndPoints", in(geo + "Plain", biggerPlain)},
        {"TopologyEmpty", in(geo + "Plain", R"(int[] faceVertexCounts = []
int[] faceVertexIndices = [])")},
        {"TopologyBroken", in(geo + "Plain", "int[] faceVertexIndices = [0, 1, 2, 9]")},
        {"TopologyMended", in(geo + "Plain", "int[] faceVertexIndices = [0, 1, 3, 2]"),
         in(geo + "Plain", "int[] faceVertexIndices = [0, 1, 2, 9]")},
        {"IndicesTwisted", in(geo + "Cube", "int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 7, 6, 0, 1, 5, 4, "
                                            "2, 3, 7, 6, 1, 2, 6, 5, 0, 4, 7, 3]")},
        {"Holes", in(geo + "Indexed", "int[] holeIndices = [1]")},
        {"HolesOutOfRange", in(geo + "Indexed", "int[] holeIndices = [0, 77]")},
        {"HolesGone", in(geo + "Indexed", "int[] holeIndices = []"),
         in(geo + "Indexed", "int[] holeIndices = [1]")},
        {"OrientationLeft", in(geo + "Cube", R"(uniform token orientation = "leftHanded")")},
        {"DoubleSided", in(geo + "Cube", "bool doubleSided = true"),
         in(geo + "Cube", R"(uniform token orientation = "leftHanded")"), false},
    };
}

Rows subdivision() {
    return {
        {"SchemeNone", in(geo + "Round", R"(uniform token subdivisionScheme = "none")")},
        {"SchemeCatmullClark", in(geo + "Cube", R"(uniform token subdivisionScheme = "catmullClark")")},
        {"SchemeBilinear", in(geo + "Round", R"(uniform token subdivisionScheme = "bilinear")")},
        {"SchemeLoopNeedsTriangles",
         in(geo + "Round", R"(uniform token subdivisionScheme = "loop")"),
         {},
         false},
        {"SchemeLoop", in(geo + "Plain", std::string(R"(uniform token subdivisionScheme = "loop"
)") + triangle)},
        {"CreasesSoften", in(geo + "Creased", "float[] creaseSharpnesses = [0.5]")},
        {"CreasesGone", in(geo + "Creased",
                           R"(int[] creaseIndices = []
int[] creaseLengths = []
float[] creaseSharpnesses = [])")},
        {"CreasesNew", in(geo + "Round", R"(int[] creaseIndices = [4, 5, 6]
int[] creaseLengths = [3]
float[] creaseSharpnesses = [8])")},
        {"CornersSoften", in(geo + "Creased", "float[] cornerSharpnesses = [0.5]")},
        {"CornersMove", in(geo + "Creased", "int[] cornerIndices = [2]")},
        {"InterpolateBoundary", in(geo + "Indexed", R"(uniform token interpolateBoundary = "edgeOnly")"),
         in(geo + "Indexed", R"(uniform token subdivisionScheme = "catmullClark")")},
        {"FaceVaryingRule", in(geo + "Vertexed", R"(uniform token faceVaryingLinearInterpolation = "none")"),
         in(geo + "Vertexed",
            R"(uniform token subdivisionScheme = "catmullClark"
uniform token interpolateBoundary = "edgeOnly"
texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0), (1, 0), (1, 1), (0, 1), (0, 0), (1, 0), (1, 1), (0, 1), (0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "faceVarying"))")},
        {"RefineLevel", view([](View& v) { v.refineLevel = 3; })},
        {"RefineLevelZero", view([](View& v) { v.refineLevel = 0; })},
    };
}

Rows subsets() {
    const std::string first = geo + "Subsets/First", second = geo + "Subsets/Second";
    return {
        {"SubsetIndices", in(first, "int[] indices = [0, 3]")},
        {"SubsetIndicesEmpty", in(first, "int[] indices = []")},
        {"SubsetIndicesOutOfRange", in(first, "int[] indices = [0, 44]")},
        {"SubsetRebound", in(first, "rel material:binding = </World/Looks/Lamp>")},
        {"SubsetUnbound", removeProperty(first + ".material:binding")},
        {"SubsetFamily", in(first, R"(uniform token familyName = "other")"), {}, false},
        {"SubsetRemoved", removePrim(second)},
        {"SubsetRenamed", rename(second, geo + "Subsets/Third"), {}, false},
        {"SubsetInactive", activate(second, false)},
        {"SubsetAdded", in(geo + "Subsets", R"(def GeomSubset "Added" {
uniform token elementType = "face"
uniform token familyName = "materialBind"
int[] indices = [3]
rel material:binding = </World/Looks/Lamp>
})")},
        {"SubsetAddedToAPlain", in(geo + "Indexed", R"(def GeomSubset "Added" {
uniform token elementType = "face"
uniform token familyName = "materialBind"
int[] indices = [3]
rel material:binding = </World/Looks/Red>
})")},
        {"SubsetParentRebound", in(geo + "Subsets", "rel material:binding = </World/Looks/Lamp>")},
        {"SubsetsWithNewTopology", in(geo + "Subsets", R"(int[] faceVertexCounts = [4, 4, 4]
int[] faceVertexIndices = [0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6])")},
        {"SubsetsAndPoints",
         in(geo + "Subsets", "point3f[] points = [(-0.4, -0.4, 0), (0, -0.4, 0), (0.4, -0.4, 0), (-0.4, 0, "
                             "0), (0.1, 0.1, 0), (0.4, 0, 0), (-0.4, 0.4, 0), (0, 0.4, 0), (0.4, 0.4, 0)]")},
        {"SubsetMaterialEdited",
         in("/World/Looks/Glossy/Surface", "color3f inputs:diffuseColor = (0.9, 0.9, 0.1)")},
    };
}

} // namespace

Rows meshRows() {
    Rows rows = shapes();
    for (const Rows& more : {subdivision(), subsets()})
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
