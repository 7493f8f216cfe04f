// Clouds of splats: their arrays, their places, their instances.
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/vt/array.h"
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

const std::string all_ = "/World/Splats", cloud = all_ + "/Cloud", half_ = all_ + "/Half",
                  swarm = all_ + "/Swarm", puff = swarm + "/Puff";

Rows arrays() {
    return {
        {"SplatsPositions",
         in(cloud,
            "point3f[] positions = [(-0.2, 0, 0), (0.1, 0.05, 0.1), (0, 0.2, -0.1), (0.05, -0.1, 0.2)]")},
        {"SplatsPositionsSet",
         set(cloud + ".positions", VtValue(VtVec3fArray{GfVec3f(-0.2f, 0.1f, 0), GfVec3f(0.1f, 0, 0.2f)}))},
        {"SplatsPositionsFewer", in(cloud, "point3f[] positions = [(-0.1, 0, 0), (0.1, 0.05, 0.1)]")},
        {"SplatsPositionsMore",
         in(cloud,
            "point3f[] positions = [(-0.1, 0, 0), (0.1, 0.05, 0.1), (0, 0.1, 0), (0, 0, 0), (0.2, 0, 0)]")},
        {"SplatsPositionsNone", in(cloud, "point3f[] positions = []")},
        {"SplatsPositionsNotANumber",
         in(cloud,
            "point3f[] positions = [(nan, 0, 0), (0.1, 0.05, 0.1), (0, 0.1, -0.1), (0.05, -0.1, 0.2)]")},
        {"SplatsPositionsMended",
         in(cloud,
            "point3f[] positions = [(-0.1, 0, 0), (0.1, 0.1, 0.1), (0, 0.1, -0.1), (0.05, -0.1, 0.2)]"),
         in(cloud,
            "point3f[] positions = [(nan, 0, 0), (0.1, 0.05, 0.1), (0, 0.1, -0.1), (0.05, -0.1, 0.2)]")},
        {"SplatsOrientations",
         in(cloud, "quatf[] orientations = [(0.7, 0, 0, 0.7), (1, 0, 0, 0), (1, 0, 0, 0), (1, 0, 0, 0)]")},
        {"SplatsOrientationsNot", removeProperty(cloud + ".orientations")},
        {"SplatsScales",
         in(cloud,
            "float3[] scales = [(0.1, 0.1, 0.05), (0.1, 0.1, 0.05), (0.1, 0.06, 0.06), (0.1, 0.1, 0.1)]")},
        {"SplatsScalesNot", removeProperty(cloud + ".scales")},
        {"SplatsOpacities", in(cloud, "float[] opacities = [0.2, 0.9, 0.3, 0]")},
        {"SplatsOpacitiesTooFew", in(cloud, "float[] opacities = [0.2, 0.9]")},
        {"SplatsDegree", in(cloud, "uniform int radiance:sphericalHarmonicsDegree = 0")},
        {"SplatsDegreeTooHigh", in(cloud, "uniform int radiance:sphericalHarmonicsDegree = 7")},
        {"SplatsCoefficients", in(cloud, R"(uniform int radiance:sphericalHarmonicsDegree = 0
float3[] radiance:sphericalHarmonicsCoefficients = [(0, 0, 1), (1, 0, 0), (0, 1, 0), (1, 0, 1)])")},
        {"SplatsCoefficientsNot", removeProperty(cloud + ".radiance:sphericalHarmonicsCoefficients")},
        {"SplatsHalf", in(half_, "point3h[] positionsh = [(0.05, 0, 0), (0, 0.1, 0.1)]")},
        {"SplatsFloatWins", in(half_, "point3f[] positions = [(0.15, 0, 0), (0, 0.15, 0)]")},
        {"SplatsHalfOpacities", in(half_, "half[] opacitiesh = [0.2, 0.9]")},
    };
}

Rows places() {
    return {
        {"SplatsMove", in(cloud, "double3 xformOp:translate = (4.2, 2.1, 0.8)")},
        {"SplatsMoveBehind", in(cloud, "double3 xformOp:translate = (4, 2.2, -4)")},
        {"SplatsMoveOut", in(cloud, "double3 xformOp:translate = (400, 2, 0.8)")},
        {"SplatsMoveParent", in(all_, R"(double3 xformOp:translate = (0.2, 0.1, 0)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
        {"SplatsTurn", in(cloud, R"(float3 xformOp:rotateXYZ = (30, 40, 50)
uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"])")},
        {"SplatsScaleToNothing", in(cloud, R"(float3 xformOp:scale = (0, 0, 0)
uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"])")},
        {"SplatsHide", in(cloud, R"(token visibility = "invisible")")},
        {"SplatsShow", in(cloud, R"(token visibility = "inherited")"),
         in(cloud, R"(token visibility = "invisible")")},
        {"SplatsPurpose", in(cloud, R"(uniform token purpose = "guide")")},
        {"SplatsRemove", removePrim(cloud)},
        {"SplatsRename", rename(cloud, all_ + "/Mist"), {}, false},
        {"SplatsDeactivate", activate(cloud, false)},
        {"SplatsActivate", activate(cloud, true), activate(cloud, false)},
        {"SplatsRetype", retype(cloud, "Xform")},
        {"SplatsAdd", usda(R"(over "World" { over "Splats" {
    def ParticleField3DGaussianSplat "More" {
        point3f[] positions = [(3, 1, 0.5)]
        float3[] scales = [(0.1, 0.1, 0.1)]
        uniform int radiance:sphericalHarmonicsDegree = 0
    }
} })")},
        {"SplatsBehindAMesh", in("/World/Geo/Cube", "double3 xformOp:translate = (4, 2, 2)")},
        {"SplatsInstancesMove",
         in(swarm, "point3f[] positions = [(2, 2.1, 0.6), (2.1, 3, 0.6), (2, 1, 0.6)]")},
        {"SplatsInstancesFewer",
         in(swarm, "int[] protoIndices = [0, 0]\npoint3f[] positions = [(2, 2, 0.6), (2, 3, 0.6)]")},
        {"SplatsInstancesHidden", in(swarm, "int64[] invisibleIds = [1]")},
        {"SplatsPrototype", in(puff, "float[] opacities = [0.9, 0.1]")},
    };
}

} // namespace

Rows splatRows() {
    Rows rows = arrays();
    for (Row& row : places())
        rows.push_back(std::move(row));
    return rows;
}

} // namespace hipr::test
