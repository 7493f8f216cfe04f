// Time, and what is animated.
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

/// Why some rows are skipped.
static const char* const animationUntracked = "it does not follow edits of skeletal animations and bindings";

static std::string four(const std::string& vector) {
    return "[(" + vector + "), (" + vector + "), (" + vector + "), (" + vector + ")]";
}

/// While the shutter is open for what frame 5 of the scene shows.
static Rows motionRows() {
    const std::string anim = "/World/Anim/";
    const Edit open = all({time(5), in("/Camera", "double shutter:open = -0.5\ndouble shutter:close = 0.5")});
    const std::string velocities = "vector3f[] velocities = " + four("12, -4, 0");
    return {
        {"ShutterOpens", in("/Camera", "double shutter:open = -0.5\ndouble shutter:close = 0.5"), time(5)},
        {"ShutterOpensLater", in("/Camera", "double shutter:open = 0.2"), open},
        {"ShutterCloses", in("/Camera", "double shutter:close = -0.5"), open},
        {"ShutterAndTime", time(6), open},
        {"MotionOfATransform",
         in(anim + "Mover", "double3 xformOp:translate.timeSamples = { 4: (0.3, 0.6, 0), 5.25: (0.5, 0.5, "
                            "0), 6: (0.9, 0.5, 0) }"),
         open},
        {"MotionEnds", in(anim + "Mover", "double3 xformOp:translate.timeSamples = { 4: (0.8, 0.6, 0.2) }"),
         open},
        {"MotionOfPoints",
         in(anim + "Bender",
            "point3f[] points.timeSamples = { 4: [(1.2, 0.2, 0), (1.8, 0.2, 0), (1.8, 0.8, "
            "0), (1.2, 0.8, 0)], 6: [(1.1, 0.1, 0), (1.8, 0.2, 0), (1.9, 0.9, 0), (1.2, 0.8, 0)] }"),
         open},
        {"MotionOfAnInstancer",
         in("/World/Inst/Cloud",
            "point3f[] positions.timeSamples = { 4: [(-0.6, -0.2, 0), (-0.2, 0.2, 0), (0.2, -0.2, 0), (0.6, "
            "0.2, 0)], 6: [(-0.5, -0.3, 0), (-0.3, 0.3, 0), (0.1, -0.1, 0), (0.5, 0.1, 0)] }"),
         open},
        {"MotionByVelocities", in(anim + "Bender", velocities), open},
        {"MotionByAccelerations", in(anim + "Bender", "vector3f[] accelerations = " + four("-400, 0, 0")),
         all({open, in(anim + "Bender", velocities)})},
        {"MotionByVelocitiesEnds", in(anim + "Bender", "vector3f[] velocities = None"),
         all({open, in(anim + "Bender", velocities)})},
        {"MotionByVelocitiesOfCurves",
         in("/World/Shapes/Ribbon", "vector3f[] velocities = [(0, 4, 0), (3, 4, 0), (0, 4, 0)]"), open},
        {"MotionByVelocitiesOfPoints",
         in("/World/Shapes/Dots", "vector3f[] velocities = [(0, 4, 0), (3, 4, 0), (0, 4, 0)]"), open},
        {"MotionByVelocitiesOfInstances", in("/World/Inst/Cloud", velocities), open},
        {"MotionByAngularVelocities",
         in("/World/Inst/Cloud", "vector3f[] angularVelocities = " + four("0, 0, 1200")), open},
        {"MotionOfSplats",
         in("/World/Splats/Cloud",
            "double3 xformOp:translate.timeSamples = { 4: (3.8, 2, 0.8), 6: (4.3, 2.2, 0.8) }"),
         open},
        {"MotionRate", setting("hipr:framesPerSecond", VtValue(60.f)),
         all({open, in(anim + "Bender", velocities), in("/World/Inst/Cloud", velocities)})},
        {"MotionOfTheCamera",
         in("/Camera", "double3 xformOp:translate.timeSamples = { 4: (4, 2, 12), 6: (3.5, 2.2, 11) }"), open},
    };
}

static Rows animationRows() {
    const std::string anim = "/World/Anim/";
    return {
        {"TimeLast", time(10)},
        {"TimeBetween", time(4.5)},
        {"TimeBack", time(1), time(10)},
        {"TimeBlinks", time(6), time(5), true},
        {"TimeBlinksBack", time(8), time(6)},
        {"TimeBeforeTheStart", time(-3), {}, false},
        {"TimeSamplesChange",
         in(anim + "Mover",
            "double3 xformOp:translate.timeSamples = { 1: (0.4, 0.6, 0), 10: (0.5, 0.5, 0) }")},
        {"TimeSamplesChangeLater",
         in(anim + "Mover", "double3 xformOp:translate.timeSamples = { 4: (0.8, 0.6, 0.2) }"), time(4)},
        {"TimeSamplesBecomeDefault", in(anim + "Mover", "double3 xformOp:translate = (0.6, 0.4, 0)")},
        {"TimeSamplesAppear",
         in("/World/Geo/Plain",
            "double3 xformOp:translate.timeSamples = { 1: (0.4, 3.4, 0), 10: (0.6, 3.6, 0) }")},
        {"TimeSamplesOfPointsChange",
         in(anim + "Bender", "point3f[] points.timeSamples = { 1: [(1.2, 0.2, 0), (1.8, 0.2, 0), (1.8, 0.8, "
                             "0), (1.2, 0.8, 0)] }")},
        {"TimeSamplesOfVisibility",
         in(anim + "Blinker", R"(token visibility.timeSamples = { 1: "invisible" })")},
        {"TimeSamplesOfTopology", time(5),
         in("/World/Geo/Indexed", "int[] holeIndices.timeSamples = { 1: [1], 5: [0, 2] }")},
        {"TimeSamplesOfALight", time(10),
         in("/World/Lights/Rect", "float intensity.timeSamples = { 1: 6, 10: 30 }")},
        {"TimeSamplesOfALightTransform", time(10),
         in("/World/Lights/Rect", "double3 xformOp:translate.timeSamples = { 1: (1, 3, 2), 10: (4, 3, 2) }")},
        {"TimeSamplesOfAMaterial", time(10),
         in("/World/Looks/Red/Surface",
            "color3f inputs:diffuseColor.timeSamples = { 1: (0.8, 0.1, 0.1), 10: (0.1, 0.1, 0.9) }")},
        {"TimeSamplesOfAnInstancer", time(10),
         in("/World/Inst/Cloud",
            "point3f[] positions.timeSamples = { 1: [(-0.6, -0.2, 0), (-0.2, 0.2, 0), (0.2, -0.2, 0), (0.6, "
            "0.2, 0)], 10: [(-0.5, -0.3, 0), (-0.3, 0.3, 0), (0.1, -0.1, 0), (0.5, 0.1, 0)] }")},
        {"TimeSamplesOfTheCount", time(10),
         in("/World/Inst/Outer",
            R"(point3f[] positions.timeSamples = { 1: [(-0.4, 0, 0), (0.4, 0, 0)], 10: [(0, 0, 0)] }
int[] protoIndices.timeSamples = { 1: [0, 0], 10: [0] })")},
        {"TimeSamplesOfTheCamera", time(10),
         in("/Camera", "double3 xformOp:translate.timeSamples = { 1: (4, 2, 12), 10: (3.5, 2.2, 11) }")},
        {"TimeSamplesOfFocalLength", time(10),
         in("/Camera", "float focalLength.timeSamples = { 1: 31, 10: 50 }")},
        {"TimeSamplesOfAPrimvar", time(10),
         in("/World/Geo/Cube", "color3f[] primvars:displayColor.timeSamples = { 1: [(1, 0, 0), (0, 1, 0), "
                               "(0, 0, 1), (1, 1, 0), (0, 1, 1), (1, 0, 1)], 10: [(0, 0, 0), (1, 1, 1), (1, "
                               "1, 1), (0, 0, 0), (1, 1, 1), (0, 0, 0)] }")},
        {"SkinMoves", time(7), time(3)},
        {"SkinAnimationChanges",
         in(anim + "Arm/Skeleton/Bend",
            "quatf[] rotations.timeSamples = { 1: [(0.92, 0, 0, 0.38), (1, 0, 0, 0)] }"),
         {},
         true,
         animationUntracked},
        {"SkinAnimationGone", removeProperty(anim + "Arm/Skeleton.skel:animationSource"), time(8)},
        {"SkinWeights", in(anim + "Arm/Skin", "float[] primvars:skel:jointWeights = [1, 1, 0.5, 0.5, 1, 1]"),
         time(8)},
        {"SkinPoints", in(anim + "Arm/Skin", "point3f[] points = [(-0.25, -0.4, 0), (0.15, -0.4, 0), (0.15, "
                                             "0, 0), (-0.15, 0, 0), (0.05, 0.4, 0), (-0.15, 0.4, 0)]")},
        {"SkinMovesAsAWhole", in(anim + "Arm", "double3 xformOp:translate = (3.6, 0.6, 0)")},
        {"SkinUnbound", removeProperty(anim + "Arm.skel:skeleton"), time(8), true, animationUntracked},
        {"SkinHidden", in(anim + "Arm", R"(token visibility = "invisible")")},
    };
}

Rows timeRows() {
    Rows rows = animationRows();
    const Rows more = motionRows();
    rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
