// Curves and points: their shapes, their primvars, their places.
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

const std::string shapes = "/World/Shapes", strands = shapes + "/Strands", ribbon = shapes + "/Ribbon",
                  dots = shapes + "/Dots", wire = shapes + "/Wire", disks = shapes + "/Disks",
                  grove = shapes + "/Grove";

Rows curves() {
    return {
        {"CurvesPoints", in(ribbon, "point3f[] points = [(2, 0.2, 0), (2.3, 0.1, 0), (2.6, 0.4, 0)]")},
        {"CurvesFewer", in(strands, R"(int[] curveVertexCounts = [3]
point3f[] points = [(0, 0, 0), (0.3, 0.6, 0), (0.6, 0, 0)]
float[] widths = [0.1, 0.2, 0.1]
color3f[] primvars:displayColor = [(0.8, 0.2, 0.2)])")},
        {"CurvesBasis", in(strands, R"(uniform token basis = "catmullRom")")},
        {"CurvesBezier", in(strands, R"(uniform token basis = "bezier"
uniform token wrap = "nonperiodic"
int[] curveVertexCounts = [7])")},
        {"CurvesLinear", in(strands, R"(uniform token type = "linear")")},
        {"CurvesPeriodic", in(strands, R"(uniform token wrap = "periodic")")},
        {"CurvesTooFewPoints", in(strands, "int[] curveVertexCounts = [1, 4]")},
        {"CurvesBeyondTheEnd", in(strands, "int[] curveVertexCounts = [3, 9]")},
        {"CurvesNotANumber", in(ribbon, "point3f[] points = [(2, nan, 0), (2.3, 0.5, 0), (2.6, 0, 0)]")},
        {"CurvesWidths", in(ribbon, "float[] widths = [0.35]")},
        {"CurvesWidthsVertexToConstant", in(strands, R"(float[] widths = [0.3] (
    interpolation = "constant"
))")},
        {"CurvesColorUniformToConstant", in(strands, R"(color3f[] primvars:displayColor = [(0.2, 0.2, 0.9)] (
    interpolation = "constant"
))")},
        {"CurvesRibbonToTube", removeProperty(ribbon + ".normals")},
        {"CurvesMove", in(strands, R"(double3 xformOp:translate = (0, -0.2, 0)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
        {"CurvesHide", in(strands, R"(token visibility = "invisible")")},
        {"CurvesMaterial", in(strands, "rel material:binding = </World/Looks/Red>")},
        {"CurvesRemoved", removePrim(strands)},
        {"CurvesRenamed", rename(strands, shapes + "/Hair"), {}, false},
        {"CurvesBecomePoints", retype(ribbon, "Points")},
        {"CurvesInstancesMove", in(grove, "point3f[] positions = [(6.1, 0.1, 0), (6.5, 0.2, 0)]")},
        {"CurvesPrototypeChanges", in(grove + "/Blade", "point3f[] points = [(0, 0, 0), (0.3, 0.4, 0)]")},
    };
}

/// Thin curves, which are round segments.
Rows wires() {
    return {
        {"WirePoints", in(wire, R"(point3f[] points = [(0, 0.5, 0), (2, 0.9, 0.1), (4, 0.5, 0), (7, 0.9, 0),
    (0, -0.2, 0.2), (3.5, -0.3, 0.2), (7, -0.2, 0.2)])")},
        {"WireFewer", in(wire, R"(int[] curveVertexCounts = [4]
float[] widths = [0.06]
color3f[] primvars:displayColor = [(0.9, 0.7, 0.2)])")},
        {"WireWidths", in(wire, "float[] widths = [0.03, 0.06]")},
        {"WireBecomesTubes", in(wire, "float[] widths = [0.3, 0.2]")},
        {"WireBecomesRibbons", in(wire, R"(normal3f[] normals = [(0, 0, 1)] (
    interpolation = "constant"
))")},
        {"WireLinear", in(wire, R"(uniform token type = "linear")")},
        {"WirePeriodic", in(wire, R"(uniform token wrap = "periodic")")},
        {"WireColor", in(wire, "color3f[] primvars:displayColor = [(0.2, 0.9, 0.3), (0.2, 0.7, 0.9)]")},
        {"WireSeeThrough", in(wire, R"(float[] primvars:displayOpacity = [0.5, 1] (
    interpolation = "uniform"
))")},
        {"WireMaterial", in(wire, "rel material:binding = </World/Looks/Red>")},
        {"WireTurns", in(wire, R"(float xformOp:rotateZ = 5
uniform token[] xformOpOrder = ["xformOp:rotateZ"])")},
        {"WireRemoved", removePrim(wire)},
    };
}

Rows points() {
    return {
        {"DotsMove", in(dots, "point3f[] points = [(3.2, 0.2, 0), (3.6, 0.3, 0), (4, 0.1, 0)]")},
        {"DotsFewer", in(dots, R"(point3f[] points = [(3.2, 0, 0), (3.6, 0.3, 0)]
float[] widths = [0.3, 0.4]
color3f[] primvars:displayColor = [(0.9, 0.3, 0.1), (0.1, 0.3, 0.9)])")},
        {"DotsNone", in(dots, "point3f[] points = []")},
        {"DotsNotANumber", in(dots, "point3f[] points = [(3.2, nan, 0), (3.6, 0.3, 0), (4, 0.1, 0)]")},
        {"DotsWidths", in(dots, "float[] widths = [0.2, 0.6, 0.3]")},
        {"DotsWidthsTooFew", in(dots, "float[] widths = [0.2]")},
        {"DotsColor",
         in(dots, "color3f[] primvars:displayColor = [(0.1, 0.9, 0.1), (0.1, 0.3, 0.9), (0.8, 0.8, 0.1)]")},
        {"DotsColorVertexToConstant", in(dots, R"(color3f[] primvars:displayColor = [(0.2, 0.2, 0.9)] (
    interpolation = "constant"
))")},
        {"DotsDisksToSpheres", removeProperty(disks + ".normals")},
        {"DotsDisksTurn", in(disks, "normal3f[] normals = [(1, 0, 0.4), (0.5, 0.2, 1)]")},
        {"DotsHide", in(dots, R"(token visibility = "invisible")")},
        {"DotsTransform", in(dots, R"(double3 xformOp:translate = (0, -0.2, 0)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
        {"DotsRemoved", removePrim(dots)},
        {"DotsInstancesMove", in(grove, "point3f[] positions = [(6, 0, 0), (6.6, 0.3, 0)]")},
        {"DotsPrototypeChanges",
         in(grove + "/Berries", "point3f[] points = [(0, 0, 0), (0.2, -0.2, 0), (0.1, 0.4, 0)]")},
        {"DotsInstancesGo", in(grove, R"(int[] protoIndices = [0]
point3f[] positions = [(6, 0, 0)])")},
    };
}

} // namespace

Rows shapeRows() {
    Rows rows = curves();
    for (const Rows& more : {wires(), points()})
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
