// Materials: bindings, every input of UsdPreviewSurface and OpenPBR Surface, the network.
#include <cctype>

#include "renderer/api/openpbr.h"
#include "testenv/edit/edits.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

/// Why some rows are skipped.
const char* const materialIsLost = "it drops a material whose nodes come or go, and populates it no more";

/// For a material: its surface displaces, too.
const char* const displaced =
    "token outputs:displacement.connect = </World/Looks/Glossy/Surface.outputs:displacement>";

const std::string geo = "/World/Geo/", looks = "/World/Looks/", glossy = looks + "Glossy/Surface";

Rows bindings() {
    return {
        {"BindingAdded", in(geo + "Plain", "rel material:binding = </World/Looks/Green>")},
        {"BindingChanged", in(geo + "Smooth", "rel material:binding = </World/Looks/Red>")},
        {"BindingRemoved", removeProperty(geo + "Smooth.material:binding")},
        {"BindingBlocked", in(geo + "Lamp", "rel material:binding = []")},
        {"BindingToNothing", in(geo + "Smooth", "rel material:binding = </World/Looks/Nowhere>")},
        {"BindingToAPrimWithoutSurface", in(geo + "Smooth", "rel material:binding = </World/Geo/Plain>")},
        {"BindingInherited", in(geo + "Group", "rel material:binding = </World/Looks/Green>")},
        {"BindingInheritedRemoved", removeProperty(geo + "Group.material:binding")},
        {"BindingStrongerThanDescendants",
         in(geo + "Group",
            R"(rel material:binding = </World/Looks/Green> (bindMaterialAs = "strongerThanDescendants"))"),
         in(geo + "Group/First", "rel material:binding = </World/Looks/Lamp>")},
        {"BindingOfACollection",
         in(geo + "Group", "rel material:binding:collection:some = [</World/Geo/Group.collection:some>, "
                           "</World/Looks/Lamp>]")},
        {"BindingOfACollectionGrows",
         in(geo + "Group",
            "rel collection:some:includes = [</World/Geo/Group/First>, </World/Geo/Group/Second>]"),
         in(geo + "Group", "rel material:binding:collection:some = [</World/Geo/Group.collection:some>, "
                           "</World/Looks/Lamp>]")},
        {"BindingOfAPurpose", in(geo + "Smooth", "rel material:binding:full = </World/Looks/Red>")},
        {"BindingOfPreview",
         in(geo + "Smooth", "rel material:binding:preview = </World/Looks/Red>"),
         {},
         false},
        {"BindingMakesTranslucent", in(geo + "Plain", "rel material:binding = </World/Looks/Glass>")},
        {"BindingMakesOpaque", in(geo + "Glass", "rel material:binding = </World/Looks/Red>")},
        {"BindingOfAPrototype",
         in("/_Pair/Left", "rel material:binding = </World/Looks/Lamp>"),
         {},
         true,
         "it does not resync the parts of a native prototype"},
        {"MaterialRemoved",
         removePrim(looks + "Red"),
         {},
         true,
         "",
         "it does not look again for a material that was missing"},
        {"MaterialRemovedAndBack", activate(looks + "Red", true), activate(looks + "Red", false)},
        {"MaterialRenamed", rename(looks + "Glossy", looks + "Shiny"), {}, false},
        {"MaterialInactive", activate(looks + "Green", false)},
        {"MaterialAdded",
         all({usda(
                  R"(over "World" { over "Looks" { def Material "New" { token outputs:surface.connect = </World/Looks/New/S.outputs:surface>
def Shader "S" { uniform token info:id = "UsdPreviewSurface"
color3f inputs:diffuseColor = (0.9, 0.5, 0)
token outputs:surface
} } } })"),
              in(geo + "Plain", "rel material:binding = </World/Looks/New>")})},
        {"MaterialAddedAfterItsBinding",
         usda(
             R"(over "World" { over "Looks" { def Material "New" { token outputs:surface.connect = </World/Looks/New/S.outputs:surface>
def Shader "S" { uniform token info:id = "UsdPreviewSurface"
color3f inputs:diffuseColor = (0.9, 0.5, 0)
token outputs:surface
} } } })"),
         in(geo + "Plain", "rel material:binding = </World/Looks/New>"), true,
         "it does not look again for a material that was missing"},
    };
}

Rows inputs() {
    return {
        {"InputDiffuseColor", in(glossy, "color3f inputs:diffuseColor = (0.9, 0.2, 0.2)")},
        {"InputRoughness", in(glossy, "float inputs:roughness = 0.9")},
        {"InputMetallic", in(glossy, "float inputs:metallic = 1")},
        {"InputClearcoat", in(glossy, "float inputs:clearcoat = 1")},
        {"InputClearcoatRoughness", in(glossy, "float inputs:clearcoatRoughness = 0.9")},
        {"InputIor", in(glossy, "float inputs:ior = 2.4")},
        {"InputSpecularWorkflow", in(glossy, "int inputs:useSpecularWorkflow = 1")},
        {"InputSpecularColor", in(glossy, "color3f inputs:specularColor = (0.9, 0.1, 0.1)"),
         in(glossy, "int inputs:useSpecularWorkflow = 1")},
        {"InputOpacity", in(glossy, "float inputs:opacity = 0.4")},
        {"InputOpacityOfGlass", in(looks + "Glass/Surface", "float inputs:opacity = 1")},
        {"InputOpacityThreshold", in(looks + "Cutout/Surface", "float inputs:opacityThreshold = 0.8")},
        {"InputOpacityThresholdZero", in(looks + "Cutout/Surface", "float inputs:opacityThreshold = 0")},
        {"InputOpacityMode", in(looks + "Glass/Surface", R"(token inputs:opacityMode = "presence")")},
        {"InputEmissive", in(glossy, "color3f inputs:emissiveColor = (3, 0.5, 0.1)")},
        {"InputEmissiveOff", in(looks + "Lamp/Surface", "color3f inputs:emissiveColor = (0, 0, 0)")},
        {"InputNormal", in(looks + "Textured/Surface", "normal3f inputs:normal = (0.5, 0, 0.8)"), {}, false},
        {"InputOcclusion", in(glossy, "float inputs:occlusion = 0.2"), {}, false},
        {"InputDisplacementOfNoOutput", in(glossy, "float inputs:displacement = 0.2"), {}, false},
        {"InputDisplacement", in(glossy, "float inputs:displacement = 0.2"),
         all({in(glossy, "float inputs:displacement = 0.1"), in(looks + "Glossy", displaced)})},
        {"InputDisplacementZero", in(glossy, "float inputs:displacement = 0"),
         all({in(glossy, "float inputs:displacement = 0.1"), in(looks + "Glossy", displaced)})},
        {"DisplacementConnected", in(looks + "Glossy", displaced),
         in(glossy, "float inputs:displacement = 0.1")},
        {"InputOutOfRange", in(glossy, "float inputs:roughness = 7")},
        {"InputNotANumber", in(glossy, "color3f inputs:diffuseColor = (nan, 0, 0)")},
        {"InputRemoved", removeProperty(glossy + ".inputs:roughness")},
        {"InputInItsOwnLayer", set(glossy + ".inputs:roughness", VtValue(0.75f))},
        {"InputOfAnUnboundMaterial", in(glossy, "float inputs:roughness = 0.9"),
         all({in(geo + "Smooth", "rel material:binding = </World/Looks/Red>"),
              in(geo + "Subsets/Second", "rel material:binding = </World/Looks/Red>")}),
         false},
        {"InputSame", in(glossy, "float inputs:roughness = 0.3"), {}, false},
    };
}

/// The value that an edit gives an input of OpenPBR: of its type, in its range, and not that of looks.usda.
std::string editedValue(const OpenPbrInputInfo& info) {
    const std::string name = std::string("inputs:") + info.name;
    if (name == "inputs:geometry_thin_walled") return "bool " + name + " = 1";
    if (info.components == 3) return "color3f " + name + " = (0.2, 0.7, 0.4)";
    return "float " + name + (info.most > 10.f ? " = 3" : info.most > 1.f ? " = 2.2" : " = 0.75");
}

/// "OpenPbr" and the input's name without underscores, each word with a capital.
std::string rowName(const OpenPbrInputInfo& info) {
    std::string name = "OpenPbr";
    bool capital = true;
    for (const char* c = info.name; *c; ++c) {
        if (*c != '_') name += char(capital ? std::toupper(*c) : *c);
        capital = *c == '_';
    }
    return name;
}

/// Every input of the table, on a material in which all parts of the model take part.
Rows openPbrRows() {
    const std::string surface = looks + "Layered/Surface";
    const Edit bind = in(geo + "Smooth", "rel material:binding = </World/Looks/Layered>");
    Rows rows;
    for (const OpenPbrInputInfo& info : openPbrInputs()) {
        if (&info == &openPbrInputs()[size_t(OpenPbrInput::DielectricPriority)]) continue; // needs two objects
        const bool shows = info.use == InputUse::Full || info.use == InputUse::Constant;
        const bool sheet = &info == &openPbrInputs()[size_t(OpenPbrInput::SubsurfaceScatterAnisotropy)];
        const Edit before = sheet ? all({bind, in(surface, "bool inputs:geometry_thin_walled = 1")}) : bind;
        rows.push_back({rowName(info), in(surface, editedValue(info)), before, shows});
    }
    rows.push_back({"OpenPbrModel", in(looks + "Red/Surface",
                                       R"(uniform token info:id = "ND_open_pbr_surface_surfaceshader")")});
    rows.push_back({"OpenPbrModelBack", in(surface, R"(uniform token info:id = "UsdPreviewSurface")"), bind});
    rows.push_back(
        {"OpenPbrTextured",
         in(surface, "color3f inputs:base_color.connect = </World/Looks/Textured/Color.outputs:rgb>"), bind});
    return rows;
}

Rows networks() {
    const std::string reader = looks + "Reader", textured = looks + "Textured";
    return {
        {"NetworkInterfaceInput",
         all({in(looks + "Red", "color3f inputs:tint = (0.1, 0.8, 0.8)"),
              in(looks + "Red/Surface",
                 "color3f inputs:diffuseColor.connect = </World/Looks/Red.inputs:tint>")})},
        {"NetworkInterfaceInputValue", in(looks + "Red", "color3f inputs:tint = (0.8, 0.8, 0.1)"),
         all({in(looks + "Red", "color3f inputs:tint = (0.1, 0.8, 0.8)"),
              in(looks + "Red/Surface",
                 "color3f inputs:diffuseColor.connect = </World/Looks/Red.inputs:tint>")})},
        {"NetworkRewired",
         in(reader + "/Surface",
            "color3f inputs:diffuseColor.connect = </World/Looks/Reader/Unused.outputs:rgb>")},
        {"NetworkDisconnected", removeProperty(reader + "/Surface.inputs:diffuseColor")},
        {"NetworkConnected",
         in(glossy, "color3f inputs:diffuseColor.connect = </World/Looks/Textured/Color.outputs:rgb>")},
        {"NetworkOfAnotherMaterialEdited", in(looks + "Textured/Color", R"(token inputs:wrapT = "mirror")"),
         in(glossy, "color3f inputs:diffuseColor.connect = </World/Looks/Textured/Color.outputs:rgb>"), true,
         "it tells of an edited node only the material that it lies in"},
        {"NetworkConnectedInside",
         all({in(looks + "Red",
                 R"(def Shader "R" { uniform token info:id = "UsdPrimvarReader_float3"
string inputs:varname = "displayColor"
float3 outputs:result
})"),
              in(looks + "Red/Surface",
                 "color3f inputs:diffuseColor.connect = </World/Looks/Red/R.outputs:result>")})},
        {"NetworkNodeRemoved", removePrim(reader + "/Paint"), {}, true, materialIsLost},
        {"NetworkNodeRenamed", rename(reader + "/Paint", reader + "/Brush"), {}, false},
        {"NetworkNodeInactive", activate(reader + "/Paint", false), {}, false, materialIsLost},
        {"NetworkOtherSurface",
         all({in(looks + "Red",
                 R"(def Shader "Other" { uniform token info:id = "UsdPreviewSurface"
color3f inputs:diffuseColor = (0.1, 0.1, 0.9)
token outputs:surface
})"),
              in(looks + "Red",
                 "token outputs:surface.connect = </World/Looks/Red/Other.outputs:surface>")})},
        {"NetworkNoSurface", in(looks + "Red", "token outputs:surface.connect = None")},
        {"NetworkUnknownSurface", in(looks + "Red/Surface", R"(uniform token info:id = "SomethingElse")")},
        {"NetworkKnownSurface", in(looks + "Red/Surface", R"(uniform token info:id = "UsdPreviewSurface")"),
         in(looks + "Red/Surface", R"(uniform token info:id = "SomethingElse")")},
        {"NetworkUnknownNode", in(reader + "/Paint", R"(uniform token info:id = "SomethingElse")")},
        {"NetworkReaderName", in(reader + "/Paint", R"(string inputs:varname = "other")")},
        {"NetworkReaderNameMissing", in(reader + "/Paint", R"(string inputs:varname = "nowhere")")},
        {"NetworkReaderFallback", in(reader + "/Paint", "float3 inputs:fallback = (0.9, 0.9, 0)"),
         in(reader + "/Paint", R"(string inputs:varname = "nowhere")")},
        {"NetworkReaderOfTexture", in(textured + "/St", R"(string inputs:varname = "uv2")"),
         in(geo + "Reader", "rel material:binding = </World/Looks/Textured>")},
        {"NetworkTransformRotation", in(textured + "/Place", "float inputs:rotation = 75")},
        {"NetworkTransformScale", in(textured + "/Place", "float2 inputs:scale = (0.4, 3)")},
        {"NetworkTransformTranslation", in(textured + "/Place", "float2 inputs:translation = (0.5, 0.3)")},
        {"NetworkTransformBypassed",
         in(textured + "/Color", "float2 inputs:st.connect = </World/Looks/Textured/St.outputs:result>")},
        {"NetworkRoughnessTextured",
         in(glossy, "float inputs:roughness.connect = </World/Looks/Textured/Color.outputs:g>")},
        {"NetworkChannel",
         in(looks + "Cutout/Surface", "float inputs:opacity.connect = </World/Looks/Cutout/Mask.outputs:g>")},
        {"NetworkChannelAlpha",
         in(looks + "Cutout/Surface", "float inputs:opacity.connect = </World/Looks/Cutout/Mask.outputs:a>")},
    };
}

/// Materials whose inputs a graph of operations computes: the stretched texture coordinates as a colour.
Rows graphs() {
    const std::string place = looks + "Graph/Place", surface = looks + "Graph/Surface";
    const Edit bind = in(geo + "Reader", "rel material:binding = </World/Looks/Graph>");
    return {
        {"GraphBound", bind},
        {"GraphConstant", in(place, "float2 inputs:scale = (0.5, 1.5)"), bind},
        {"GraphConstantThatChangesNothing", in(place, "float2 inputs:scale = (1, 1)"), bind},
        {"GraphRotation", in(place, "float inputs:rotation = 40"), bind},
        {"GraphOfOpacity",
         in(surface, "float inputs:opacity.connect = </World/Looks/Graph/Place.outputs:result>"), bind},
        {"GraphNodeBypassed",
         in(surface, "color3f inputs:diffuseColor.connect = </World/Looks/Graph/St.outputs:result>"), bind},
        {"GraphNodeAdded",
         all({in(looks + "Graph",
                 R"(def Shader "More" { uniform token info:id = "UsdTransform2d"
float2 inputs:in.connect = </World/Looks/Graph/Place.outputs:result>
float2 inputs:translation = (0.2, 0.1)
float2 outputs:result
})"),
              in(surface, "color3f inputs:diffuseColor.connect = </World/Looks/Graph/More.outputs:result>")}),
         bind},
        {"GraphDisconnected", removeProperty(surface + ".inputs:diffuseColor"), bind},
    };
}

} // namespace

Rows materialRows() {
    Rows rows = bindings();
    for (const Rows& more : {inputs(), openPbrRows(), networks(), graphs()})
        rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

} // namespace hipr::test
