// Primvars: value, type, interpolation, indices, presence.
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

const std::string geo = "/World/Geo/";

Rows colors() {
    return {
        {"DisplayColor", in(geo + "Plain", "color3f[] primvars:displayColor = [(0.1, 0.2, 0.9)]")},
        {"DisplayColorAdded",
         in(geo + "Cube",
            R"(color3f[] primvars:displayColor = [(0.1, 0.2, 0.9)] (interpolation = "constant"))")},
        {"DisplayColorRemoved", removeProperty(geo + "Indexed.primvars:displayColor")},
        {"DisplayColorBlocked", in(geo + "Vertexed", "color3f[] primvars:displayColor = None")},
        {"DisplayColorTooShort",
         in(geo + "Vertexed", "color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)]")},
        {"DisplayColorTooLong",
         in(geo + "Indexed", "int[] primvars:displayColor:indices = [0, 1, 1, 0, 1, 1]"),
         {},
         false},
        {"DisplayColorEmpty", in(geo + "Plain", "color3f[] primvars:displayColor = []")},
        {"DisplayColorNotANumber", in(geo + "Plain", "color3f[] primvars:displayColor = [(nan, 0, 0)]")},
        {"DisplayColorOfOneVertex",
         in(geo + "Vertexed",
            "color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 0), (1, 1, 1), (1, "
            "0, 1), (0.2, 0.2, 0.2), (0.8, 0.8, 0.8), (0.5, 0.1, 0.1)]")},
        {"DisplayColorOfASubdivided",
         in(geo + "Round", "color3f[] primvars:displayColor = [(0.1, 0.6, 0.2)]")},
        {"InterpolationVertexToVarying",
         in(geo + "Vertexed", R"(color3f[] primvars:displayColor (interpolation = "varying"))"),
         {},
         false},
        {"InterpolationVaryingSubdivided",
         in(geo + "Vertexed", R"(color3f[] primvars:displayColor (interpolation = "varying"))"),
         in(geo + "Vertexed", R"(uniform token subdivisionScheme = "catmullClark")")},
        {"InterpolationUniformToConstant",
         in(geo + "Indexed",
            R"(color3f[] primvars:displayColor = [(0.9, 0.3, 0.1)] (interpolation = "constant")
int[] primvars:displayColor:indices = [0])")},
        {"InterpolationUniformToFaceVarying",
         in(geo + "Indexed",
            R"(color3f[] primvars:displayColor (interpolation = "faceVarying")
int[] primvars:displayColor:indices = [0, 1, 1, 0, 1, 0, 0, 1, 0, 0, 1, 1, 1, 0, 1, 0])")},
        {"InterpolationWrong",
         in(geo + "Indexed", R"(color3f[] primvars:displayColor (interpolation = "vertex"))"),
         {},
         true,
         "it keeps the interpolation of before, which fits"},
        {"IndicesOfAPrimvar", in(geo + "Indexed", "int[] primvars:displayColor:indices = [1, 0, 0, 1]")},
        {"IndicesOfAPrimvarGone", in(geo + "Indexed", R"(int[] primvars:displayColor:indices = None
color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)])")},
        {"IndicesOfAPrimvarOutOfRange",
         in(geo + "Indexed", "int[] primvars:displayColor:indices = [1, 0, 0, 7]")},
        {"IndexedValues",
         in(geo + "Indexed", "color3f[] primvars:displayColor = [(0.2, 0.9, 0.1), (0.9, 0.9, 0.9)]")},
        {"TypeOfAPrimvar", in(geo + "Reader", "double3[] primvars:other = [(0.3, 0.9, 0.1)]"),
         in("/World/Looks/Reader/Paint", R"(string inputs:varname = "other")")},
        {"DisplayOpacity", in(geo + "Ghost", "float[] primvars:displayOpacity = [0.8]")},
        {"DisplayOpacityFull", in(geo + "Ghost", "float[] primvars:displayOpacity = [1]")},
        {"DisplayOpacityRemoved", removeProperty(geo + "Ghost.primvars:displayOpacity")},
        {"DisplayOpacityAdded", in(geo + "Cube", "float[] primvars:displayOpacity = [0.3]")},
        {"DisplayOpacityPerVertex",
         in(geo + "Vertexed",
            R"(float[] primvars:displayOpacity = [0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1, 1] (interpolation = "vertex"))")},
    };
}

Rows others() {
    return {
        {"St", in(geo + "Textured", "texCoord2f[] primvars:st = [(0.2, 0), (0.7, 0), (0.7, 0.3), (0, 0.5)]")},
        {"StRemoved", removeProperty(geo + "Textured.primvars:st")},
        {"StAdded",
         in(geo + "Plain",
            R"(texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex"))")},
        {"StFaceVarying",
         in(geo + "Cutout",
            R"(texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1), (0, 0), (1, 0), (1, 1), (0, 1), (0, 0), (1, 0), (1, 1), (0, 1), (0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "faceVarying"))")},
        {"StAsFloats",
         in(geo + "Textured", "float2[] primvars:st = [(0.2, 0), (0.7, 0), (0.7, 0.3), (0, 0.5)]")},
        {"Normals",
         in(geo + "Smooth",
            "normal3f[] normals = [(0.5, 0.5, 0.7), (0, 0.5, 0.8), (0.5, -0.5, 0.7), (-0.5, 0, 0.8), (0.3, "
            "0, 1), (0.5, 0, 0.8), (-0.5, 0.5, 0.7), (0, 0.5, 0.8), (0.5, 0.5, 0.7)]")},
        {"NormalsAndPoints",
         in(geo + "Smooth",
            R"(normal3f[] normals = [(0.5, 0.5, 0.7), (0, 0.5, 0.8), (0.5, -0.5, 0.7), (-0.5, 0, 0.8), (0.3, 0, 1), (0.5, 0, 0.8), (-0.5, 0.5, 0.7), (0, 0.5, 0.8), (0.5, 0.5, 0.7)]
point3f[] points = [(-0.3, -0.4, 0), (0, -0.4, 0), (0.4, -0.3, 0), (-0.4, 0, 0), (0, 0, 0.2), (0.4, 0, 0), (-0.4, 0.4, 0), (0, 0.4, 0), (0.3, 0.4, 0)])")},
        {"NormalsRemoved", removeProperty(geo + "Smooth.normals")},
        {"NormalsAdded",
         in(geo + "Plain",
            R"(normal3f[] normals = [(0.3, 0, 1), (0, 0, 1), (0, 0.4, 1), (0.5, 0.5, 1)] (interpolation = "vertex"))")},
        {"NormalsFaceVarying",
         in(geo + "Plain",
            R"(normal3f[] normals = [(0.3, 0, 1), (0, 0, 1), (0, 0.4, 1), (0.5, 0.5, 1)] (interpolation = "faceVarying"))")},
        {"NormalsUniform",
         in(geo + "Smooth",
            R"(normal3f[] normals = [(0.3, 0, 1), (0, 0, 1), (0, 0.4, 1), (0.5, 0.5, 1)] (interpolation = "uniform"))")},
        {"NormalsAsPrimvar",
         in(geo + "Plain",
            R"(normal3f[] primvars:normals = [(0.3, 0, 1), (0, 0, 1), (0, 0.4, 1), (0.5, 0.5, 1)] (interpolation = "vertex"))")},
        {"NormalsOnASubdivided",
         in(geo + "Round",
            R"(normal3f[] normals = [(1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0)] (interpolation = "vertex"))"),
         {},
         false},
        {"Custom",
         in(geo + "Reader", "color3f[] primvars:paint = [(0, 0.1, 0), (0.1, 1, 0), (0, 0.1, 1), (1, 1, 0.1), "
                            "(0.1, 1, 1), (1, 0.1, 1), (0.2, 0.2, 0.2), (0.8, 0.8, 0.8), (0.5, 0.9, 0.1)]")},
        {"CustomConstant",
         in(geo + "Reader", R"(color3f[] primvars:paint = [(0.1, 0.9, 0.9)] (interpolation = "constant"))")},
        {"CustomRemoved", removeProperty(geo + "Reader.primvars:paint")},
        {"CustomInherited",
         in("/World/Geo", R"(color3f[] primvars:paint = [(0.1, 0.9, 0.3)] (interpolation = "constant"))"),
         removeProperty(geo + "Reader.primvars:paint")},
        {"CustomUnusedType", in(geo + "Vertexed", R"(string[] primvars:custom2 = ["a"])"), {}, false},
        {"CustomUnusedAdded",
         in(geo + "Vertexed", R"(float[] primvars:custom3 = [1] (interpolation = "constant"))"),
         {},
         false},
        {"DisplayColorInherited",
         in("/World/Geo/Group",
            R"(color3f[] primvars:displayColor = [(0.1, 0.9, 0.3)] (interpolation = "constant"))")},
        {"DisplayColorOfAPrototype",
         in("/_Pair/Right", "color3f[] primvars:displayColor = [(0.9, 0.3, 0.1)]")},
    };
}

} // namespace

Rows primvarRows() {
    Rows rows = colors();
    const Rows more = others();
    rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
