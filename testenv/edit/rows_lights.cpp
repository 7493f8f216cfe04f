// Lights: every attribute, type, presence.
#include "testenv/edit/edits.h"

namespace hipr::test {

namespace {

const std::string lights = "/World/Lights/";
const char* const ramp = "asset texture:file = @../../scenes/textures/ramp.png@";

Rows attributes() {
    return {
        {"LightDomeIntensity", in(lights + "Dome", "float intensity = 0.9")},
        {"LightDomeColor", in(lights + "Dome", "color3f color = (1, 0.2, 0.2)")},
        {"LightDomeTexture", in(lights + "Dome", ramp)},
        {"LightDomeTextureMissing", in(lights + "Dome", "asset texture:file = @nowhere.png@"), {}, false},
        {"LightDomeTextureGone", in(lights + "Dome", "asset texture:file = @@"), in(lights + "Dome", ramp)},
        {"LightDomeTextureOther",
         in(lights + "Dome", "asset texture:file = @../../scenes/textures/tile.1001.png@"),
         in(lights + "Dome", ramp)},
        {"LightDomeTextureSharedWithMaterial",
         in("/World/Looks/Textured/Color", "asset inputs:file = @../../scenes/textures/tile.1001.png@"),
         in(lights + "Dome", ramp)},
        {"LightDomeFormat", in(lights + "Dome", R"(token texture:format = "angular")"),
         in(lights + "Dome", ramp)},
        {"LightDomeFormatBack", in(lights + "Dome", R"(token texture:format = "latlong")"),
         in(lights + "Dome", std::string(ramp) + R"(
token texture:format = "mirroredBall")")},
        {"LightSphereAsAPoint", in(lights + "Sphere", "bool treatAsPoint = true")},
        {"LightCylinderAsALine", in(lights + "Tube", "bool treatAsLine = true")},
        {"LightDomeTurns", in(lights + "Dome", R"(float xformOp:rotateY = 90
uniform token[] xformOpOrder = ["xformOp:rotateY"])"),
         in(lights + "Dome", ramp)},
        {"LightDistantIntensity", in(lights + "Sun", "float intensity = 900")},
        {"LightDistantAngle", in(lights + "Sun", "float angle = 30")},
        {"LightDistantAngleZero", in(lights + "Sun", "float angle = 0")},
        {"LightDistantTurns", in(lights + "Sun", "float xformOp:rotateX = -70")},
        {"LightRectIntensity", in(lights + "Rect", "float intensity = 20")},
        {"LightRectIntensityByItsNewName", in(lights + "Rect", "float inputs:intensity = 20")},
        {"LightRectIntensityZero", in(lights + "Rect", "float intensity = 0")},
        {"LightRectIntensityFromZero", in(lights + "Rect", "float intensity = 3"),
         in(lights + "Rect", "float intensity = 0")},
        {"LightRectExposure", in(lights + "Rect", "float exposure = 2")},
        {"LightRectColor", in(lights + "Rect", "color3f color = (0.1, 1, 0.2)")},
        {"LightRectTemperature", in(lights + "Rect", R"(bool enableColorTemperature = true
float colorTemperature = 2500)")},
        {"LightRectTemperatureOff", in(lights + "Rect", "float colorTemperature = 2500"), {}, false},
        {"LightRectNormalize", in(lights + "Rect", "bool normalize = true")},
        {"LightRectWidth", in(lights + "Rect", "float width = 2")},
        {"LightRectHeight", in(lights + "Rect", "float height = 2")},
        {"LightRectTexture", in(lights + "Rect", ramp)},
        {"LightRectDiffuse", in(lights + "Rect", "float diffuse = 0.2")},
        {"LightRectSpecular", in(lights + "Rect", "float specular = 0"),
         in("/World/Looks/Glossy/Surface", "float inputs:roughness = 0.5")},
        {"LightRectGroup", in(lights + "Rect", "string inputs:hipr:lightGroup = \"key\"")},
        {"LightRectGroupOther", in(lights + "Rect", "string inputs:hipr:lightGroup = \"fill\""),
         in(lights + "Rect", "string inputs:karma:light:lpetag = \"key\"")},
        {"LightRectMoves", in(lights + "Rect", "double3 xformOp:translate = (2, 2, 2)")},
        {"LightSphereRadius", in(lights + "Sphere", "float radius = 0.4")},
        {"LightSphereRadiusNegative", in(lights + "Sphere", "float radius = -1")},
        {"LightSphereNotANumber", in(lights + "Sphere", "float intensity = nan")},
        {"LightDiskRadius", in(lights + "Disk", "float radius = 0.6")},
        {"LightCylinderLength", in(lights + "Tube", "float length = 5")},
        {"LightCylinderRadius", in(lights + "Tube", "float radius = 0.2")},
        {"LightHidden", in(lights + "Rect", R"(token visibility = "invisible")")},
        {"LightShown", in(lights + "Rect", R"(token visibility = "inherited")"),
         in(lights + "Rect", R"(token visibility = "invisible")")},
        {"LightHiddenByItsParent", in("/World/Lights", R"(token visibility = "invisible")")},
        {"LightMovesWithItsParent", in("/World/Lights", R"(double3 xformOp:translate = (1, 0, 0)
uniform token[] xformOpOrder = ["xformOp:translate"])")},
        {"LightDomeHidden", in(lights + "Dome", R"(token visibility = "invisible")")},
    };
}

Rows shaping() {
    const std::string profile = "asset shaping:ies:file = @../../scenes/profiles/spot.ies@";
    return {
        {"LightRectFocus", in(lights + "Rect", "float shaping:focus = 12")},
        {"LightRectFocusTint", in(lights + "Rect", "color3f shaping:focusTint = (1, 0, 0)"),
         in(lights + "Rect", "float shaping:focus = 12")},
        {"LightRectCone", in(lights + "Rect", "float shaping:cone:angle = 20")},
        {"LightRectConeByItsNewName", in(lights + "Rect", "float inputs:shaping:cone:angle = 20")},
        {"LightRectConeSoftness", in(lights + "Rect", "float shaping:cone:softness = 1"),
         in(lights + "Rect", "float shaping:cone:angle = 20")},
        {"LightRectConeWideOpen", in(lights + "Rect", "float shaping:cone:angle = 180"), {}, false},
        {"LightRectProfile", in(lights + "Rect", profile)},
        {"LightRectProfileGone", in(lights + "Rect", "asset shaping:ies:file = @@"),
         in(lights + "Rect", profile)},
        {"LightRectProfileMissing", in(lights + "Rect", "asset shaping:ies:file = @nowhere.ies@"), {}, false},
        {"LightRectProfileScale", in(lights + "Rect", "float shaping:ies:angleScale = 0.4"),
         in(lights + "Rect", profile)},
        {"LightRectProfileNormalize", in(lights + "Rect", "bool shaping:ies:normalize = true"),
         in(lights + "Rect", profile)},
        {"LightDomeShaped", in(lights + "Dome", "float shaping:focus = 12"), {}, false},
        {"LightDistantCone", in(lights + "Sun", "float shaping:cone:angle = 2"),
         in(lights + "Sun", "float angle = 30")},
    };
}

/// A collection of the rectangle light.
Edit link(const std::string& collection, const std::string& includes) {
    const std::string name = "collection:" + collection;
    return in(lights + "Rect",
              "uniform bool " + name + ":includeRoot = false\nrel " + name + ":includes = " + includes);
}

Rows shadows() {
    const Edit plainOnly = link("lightLink", "</World/Geo/Plain>");
    return {
        {"LightRectShadowOff", in(lights + "Rect", "bool shadow:enable = false")},
        {"LightRectShadowOffByItsNewName", in(lights + "Rect", "bool inputs:shadow:enable = false")},
        {"LightRectShadowColor", in(lights + "Rect", "color3f shadow:color = (1, 0, 0)")},
        {"LightRectShadowDistance", in(lights + "Rect", "float shadow:distance = 0.05")},
        {"LightRectShadowFalloff", in(lights + "Rect", "float shadow:falloff = 4"),
         in(lights + "Rect", "float shadow:distance = 5")},
        {"LightRectShadowFalloffGamma", in(lights + "Rect", "float shadow:falloffGamma = 3"),
         in(lights + "Rect", "float shadow:distance = 5\nfloat shadow:falloff = 5")},
        {"LightLinked", plainOnly},
        {"LightLinkedToMore", link("lightLink", "[</World/Geo/Plain>, </World/Inst>]"), plainOnly},
        {"LightLinkedToOther", link("lightLink", "</World/Inst>"), plainOnly},
        {"LightLinkedToAll", in(lights + "Rect", "uniform bool collection:lightLink:includeRoot = true"),
         plainOnly},
        {"LightShadowLinked", link("shadowLink", "</World/Inst>")},
        {"LightLinkedThingMoves", in("/World/Geo/Plain", R"(double3 xformOp:translate = (0.2, 0, 0.1)
uniform token[] xformOpOrder = ["xformOp:translate"])"),
         plainOnly},
    };
}

/// Meshes that emit, and so are lights.
Rows meshes() {
    const std::string lamp = "/World/Geo/Lamp", surface = "/World/Looks/Lamp/Surface";
    const Edit roundGlows = in("/World/Geo/Round", "rel material:binding = </World/Looks/Lamp>");
    return {
        {"MeshLightColor", in(surface, "color3f inputs:emissiveColor = (0.2, 2, 9)")},
        {"MeshLightOff", in(surface, "color3f inputs:emissiveColor = (0, 0, 0)")},
        {"MeshLightOn", in(surface, "color3f inputs:emissiveColor = (2, 1.5, 1)"),
         in(surface, "color3f inputs:emissiveColor = (0, 0, 0)")},
        {"MeshLightGroup", in(lamp, "string primvars:hipr:lightGroup = \"key\"")},
        {"MeshLightGroupGone", removeProperty(lamp + ".primvars:hipr:lightGroup"),
         in(lamp, "string primvars:hipr:lightGroup = \"key\"")},
        {"MeshLightOpacity", in(surface, "float inputs:opacity = 0.4")},
        {"MeshLightOtherMaterial", in(lamp, "rel material:binding = </World/Looks/Green>")},
        {"MeshLightMore", roundGlows},
        {"MeshLightFewer", removeProperty("/World/Geo/Round.material:binding"), roundGlows},
        {"MeshLightMoves", in(lamp, "double3 xformOp:translate = (3.5, 2.5, 0.8)")},
        {"MeshLightScales", in(lamp, R"(float3 xformOp:scale = (2, 0.5, 1)
uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"])")},
        {"MeshLightHidden", in(lamp, R"(token visibility = "invisible")")},
        {"MeshLightShown", in(lamp, R"(token visibility = "inherited")"),
         in(lamp, R"(token visibility = "invisible")")},
        {"MeshLightPoints", in(lamp, "point3f[] points = [(-0.5, -0.2, 0), (0.2, -0.2, 0), (-0.2, 0.2, 0.3), "
                                     "(0.2, 0.4, 0)]")},
        {"MeshLightFaces", in(lamp, "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 3]")},
        {"MeshLightRefined", view([](View& v) { v.refineLevel = 0; }), roundGlows},
        {"MeshLightSubset", in("/World/Geo/Subsets/First", "rel material:binding = </World/Looks/Lamp>")},
        {"MeshLightSubsetFaces", in("/World/Geo/Subsets/First", "int[] indices = [1, 3]"),
         in("/World/Geo/Subsets/First", "rel material:binding = </World/Looks/Lamp>")},
        {"MeshLightInstances", in("/World/Inst", R"(rel material:binding = </World/Looks/Lamp> (
bindMaterialAs = "strongerThanDescendants"))")},
        {"MeshLightRemoved", removePrim(lamp)},
        {"MeshLightRenamedPastOthers", rename(lamp, "/World/Geo/Aaa"), {}, false},
        {"MeshLightAlone", removePrim("/World/Lights")},
    };
}

Rows presence() {
    return {
        {"LightRemovedFirst", removePrim(lights + "Disk")},
        {"LightRemovedDome", removePrim(lights + "Dome")},
        {"LightRemovedAll", removePrim("/World/Lights")},
        {"LightRemovedAllButOne",
         all({removePrim(lights + "Dome"), removePrim(lights + "Sun"), removePrim(lights + "Rect"),
              removePrim(lights + "Sphere"), removePrim(lights + "Disk")})},
        {"LightInactive", activate(lights + "Sphere", false)},
        {"LightActiveAgain", activate(lights + "Sphere", true), activate(lights + "Sphere", false)},
        {"LightAdded", in("/World/Lights", R"(def SphereLight "Added" {
float intensity = 9
float radius = 0.2
double3 xformOp:translate = (7, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
})")},
        {"LightAddedBeforeTheOthers", usda(
                                          R"(over "World" { def SphereLight "Ahead" {
float intensity = 9
float radius = 0.2
double3 xformOp:translate = (1, 1, 1)
uniform token[] xformOpOrder = ["xformOp:translate"]
} })")},
        {"LightAddedWithoutOthers", usda(R"(def SphereLight "Only" {
float intensity = 9
float radius = 0.5
double3 xformOp:translate = (4, 2, 3)
uniform token[] xformOpOrder = ["xformOp:translate"]
})"),
         removePrim("/World/Lights")},
        {"LightRenamed", rename(lights + "Rect", lights + "Rectangle"), {}, false},
        {"LightRenamedPastOthers", rename(lights + "Rect", lights + "Area")},
        {"LightReparented", rename(lights + "Rect", "/World/Geo/Rect")},
        {"LightRectToDisk", retype(lights + "Rect", "DiskLight")},
        {"LightDiskToRect", retype(lights + "Disk", "RectLight")},
        {"LightSphereToCylinder", retype(lights + "Sphere", "CylinderLight")},
        {"LightToXform", retype(lights + "Sphere", "Xform")},
        {"LightDistantToDome", retype(lights + "Sun", "DomeLight")},
        {"LightSecondDome", in("/World/Lights", R"(def DomeLight "Second" { color3f color = (0, 0.5, 0)
})")},
        {"LightAttributeAfterTypeSwap", in(lights + "Rect", "float radius = 0.9"),
         retype(lights + "Rect", "DiskLight")},
    };
}

} // namespace

Rows lightRows() {
    Rows rows = attributes();
    for (const Rows& more : {shaping(), shadows(), meshes(), presence()})
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
