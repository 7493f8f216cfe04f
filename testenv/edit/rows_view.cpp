// The camera, the window, and what the host asks for.
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

Rows cameras() {
    return {
        {"CameraMoves", in("/Camera", "double3 xformOp:translate = (4.3, 2.1, 11)")},
        {"CameraTurns", in("/Camera", R"(float xformOp:rotateY = 5
uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY"])")},
        {"CameraReparented",
         all({rename("/Camera", "/World/Camera"), view([](View& v) { v.camera = "/World/Camera"; })}),
         {},
         false},
        {"CameraFocalLength", in("/Camera", "float focalLength = 50")},
        {"CameraHorizontalAperture", in("/Camera", "float horizontalAperture = 30"), {}, false},
        {"CameraVerticalAperture", in("/Camera", "float verticalAperture = 8")},
        {"CameraApertureOffset", in("/Camera", R"(float horizontalApertureOffset = 3
float verticalApertureOffset = -2)")},
        {"CameraClipping", in("/Camera", "float2 clippingRange = (2, 60)")},
        {"CameraOrthographic", in("/Camera", R"(token projection = "orthographic"
float horizontalAperture = 80
float verticalAperture = 40)")},
        {"CameraPerspectiveAgain", in("/Camera", R"(token projection = "perspective")"),
         in("/Camera",
            R"(token projection = "orthographic"
float horizontalAperture = 80
float verticalAperture = 40)")},
        {"CameraFStop", in("/Camera", "float fStop = 4"), in("/Camera", "float focusDistance = 6")},
        {"CameraFStopWithoutFocus", in("/Camera", "float fStop = 4"), {}, false},
        {"CameraRefocused", in("/Camera", "float focusDistance = 14"),
         in("/Camera", "float fStop = 4\nfloat focusDistance = 6")},
        {"CameraAperture", in("/Camera", "custom int hipr:apertureBlades = 3"),
         in("/Camera", "float fStop = 2\nfloat focusDistance = 6")},
        {"CameraApertureTurned", in("/Camera", "custom float hipr:apertureRotation = 30"),
         in("/Camera", "float fStop = 2\nfloat focusDistance = 6\ncustom int hipr:apertureBlades = 3")},
        {"CameraOpensAndMoves",
         in("/Camera",
            "float fStop = 4\nfloat focusDistance = 6\ndouble3 xformOp:translate = (4.3, 2.1, 11)")},
        {"CameraExposure", in("/Camera", "custom float exposure = 1")},
        {"CameraIso", in("/Camera", "custom float exposure:iso = 400")},
        {"CameraExposureAndEdit",
         all({in("/Camera", "custom float exposure = 1"), removePrim("/World/Geo/Cube")})},
        {"CameraExposureIgnored", in("/Camera", "custom float exposure = 1"),
         setting("enableExposureCompensation", VtValue(false)), false},
        {"CameraClippingPlanes",
         in("/Camera", "float4[] clippingPlanes = [(1, 0, 0, 0.5), (0, -0.3, 1, 14)]")},
        {"CameraOther", view([](View& v) { v.camera = "/Side"; })},
        {"CameraOtherMoves", in("/Side", "double3 xformOp:translate = (1, 2, 10)"),
         view([](View& v) { v.camera = "/Side"; })},
        {"CameraUnusedMoves", in("/Side", "double3 xformOp:translate = (1, 2, 10)"), {}, false},
        {"CameraAdded", all({usda(R"(def Camera "New" { double3 xformOp:translate = (4, 2, 9)
uniform token[] xformOpOrder = ["xformOp:translate"]
float focalLength = 30
})"),
                             view([](View& v) { v.camera = "/New"; })})},
    };
}

Rows host() {
    return {
        {"WindowSize", view([](View& v) { v.width = 48, v.height = 40; })},
        {"WindowSizeSmaller", view([](View& v) { v.width = 16, v.height = 16; }),
         view([](View& v) { v.width = 70, v.height = 30; })},
        {"WindowSizeAndEdit", all({view([](View& v) { v.width = 50; }), removePrim("/World/Geo/Cube")})},
        {"TagsProxy", view([](View& v) { v.proxy = true; })},
        {"TagsWithoutRender", view([](View& v) { v.render = false; })},
        {"TagsGuide", view([](View& v) { v.guide = true; }),
         in("/World/Geo/Cube", R"(uniform token purpose = "guide")")},
        {"TagsBack", view([](View& v) { v.proxy = false; }), view([](View& v) { v.proxy = true; })},
        {"TagsAndEdit", all({view([](View& v) { v.proxy = true; }),
                             in("/World/Geo/Proxy", "color3f[] primvars:displayColor = [(0.9, 0.9, 0.9)]")})},
        {"TagsShowWhatChanged", view([](View& v) { v.proxy = true; }),
         in("/World/Geo/Proxy",
            R"(color3f[] primvars:displayColor = [(0.9, 0.9, 0.9)]
double3 xformOp:translate = (6.6, 2.6, 0))")},
        {"SettingDepth", setting("hipr:maxDepth", VtValue(1))},
        {"SettingRoulette", setting("hipr:rouletteDepth", VtValue(1))},
        {"SettingFilter", setting("hipr:pixelFilter", VtValue(std::string("box")))},
        {"SettingFilterWidth", setting("hipr:filterWidth", VtValue(3.f))},
        {"SettingClamp", setting("hipr:fireflyClamp", VtValue(0.1f))},
        {"SettingSeed", setting("hipr:seed", VtValue(7))},
        {"SettingTraversal", setting("hipr:traversal", VtValue(std::string("bvh"))), {}, false},
        {"SettingTraversalAndEdit", removePrim("/World/Geo/Cube"),
         setting("hipr:traversal", VtValue(std::string("bvh")))},
        {"SettingNoSky", setting("domeLightCameraVisibility", VtValue(false)), removePrim("/World/Wall")},
        {"SettingNoLights", setting("enableSceneLights", VtValue(false))},
        {"SettingLightsAgain", setting("enableSceneLights", VtValue(true)),
         setting("enableSceneLights", VtValue(false))},
        {"SettingNoMaterials", setting("enableSceneMaterials", VtValue(false))},
        {"SettingMaterialsAgain", setting("enableSceneMaterials", VtValue(true)),
         setting("enableSceneMaterials", VtValue(false))},
        {"LightsEditedWhileOff", setting("enableSceneLights", VtValue(true)),
         all({setting("enableSceneLights", VtValue(false)), removePrim("/World/Lights/Rect"),
              in("/World/Lights/Disk", "float intensity = 30")})},
        {"MaterialsEditedWhileOff", setting("enableSceneMaterials", VtValue(true)),
         all({setting("enableSceneMaterials", VtValue(false)), removePrim("/World/Looks/Red"),
              in("/World/Looks/Glossy/Surface", "float inputs:roughness = 0.9")}),
         true, "", "it does not look again for a material that was missing"},
    };
}

} // namespace

Rows viewRows() {
    Rows rows = cameras();
    const Rows more = host();
    rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
