/// The prims that MaterialX documents become.
#include "testenv/unit/mtlxFile/documents.h"

#include "pxr/base/gf/matrix3d.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/vt/array.h"
#include "pxr/usd/sdf/assetPath.h"
#include "pxr/usd/sdf/attributeSpec.h"
#include "pxr/usd/usd/stage.h"
#include "pxr/usd/usdShade/connectableAPI.h"
#include "pxr/usd/usdShade/material.h"
#include "pxr/usd/usdShade/shader.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class MtlxLayers : public MtlxDocuments {
protected:
    ~MtlxLayers() override { EXPECT_THAT(_warnings.texts(), IsEmpty()); }

    /// The value of the input `x` of a constant node.
    VtValue value(std::string const& type, std::string const& text) const {
        const SdfLayerRefPtr layer = open("<n name=\"n\" type=\"float\"><input name=\"x\" type=\"" + type +
                                          "\" value=\"" + text + "\"/></n>");
        const SdfAttributeSpecHandle spec =
            layer->GetAttributeAtPath(SdfPath("/MaterialX/NodeGraphs/n.inputs:x"));
        const VtValue value = spec ? spec->GetDefaultValue() : VtValue();
        layer->Clear(); // the next one of the same name is read anew
        return value;
    }

    TestWarnings _warnings;
};

TEST_F(MtlxLayers, HaveMaterialsWithTheGraphsTheyUse) {
    const SdfLayerRefPtr layer = open(R"(
  <nodegraph name="NG">
    <image name="base" type="color3">
      <input name="file" type="filename" value="tex/base.jpg" colorspace="srgb_texture" />
    </image>
    <image name="rough" type="float"><input name="file" type="filename" value="tex/rough.jpg"/></image>
    <output name="base_output" type="color3" nodename="base" />
    <output name="rough_output" type="float" nodename="rough" />
  </nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base_color" type="color3" nodegraph="NG" output="base_output" />
    <input name="specular_roughness" type="float" nodegraph="NG" output="rough_output" />
    <input name="metalness" type="float" value="0.5" />
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S" />
  </surfacematerial>)",
                                      R"(version="1.38" colorspace="lin_rec709")");
    EXPECT_EQ(textOf(layer), materialX(R"(
def NodeGraph "NG"
{
    color3f outputs:base_output.connect = </MaterialX/NodeGraphs/NG/base.outputs:out>
    float outputs:rough_output.connect = </MaterialX/NodeGraphs/NG/rough.outputs:out>
    def Shader "base"
    {
        uniform token info:id = "ND_image_color3"
        token inputs:colorSpace:file = "srgb_texture"
        asset inputs:file = @tex/base.jpg@ (
            colorSpace = "srgb_texture"
        )
        color3f outputs:out
    }
    def Shader "rough"
    {
        uniform token info:id = "ND_image_float"
        asset inputs:file = @tex/rough.jpg@
        float outputs:out
    }
})",
                                       R"(
def Material "M"
{
    float inputs:metalness = 0.5
    token outputs:mtlx:surface.connect = </MaterialX/Materials/M/S.outputs:out>
    def Shader "S"
    {
        uniform token info:id = "ND_standard_surface_surfaceshader"
        color3f inputs:base_color.connect = </MaterialX/Materials/M/NG.outputs:base_output>
        float inputs:metalness.connect = </MaterialX/Materials/M.inputs:metalness>
        float inputs:specular_roughness.connect = </MaterialX/Materials/M/NG.outputs:rough_output>
        token outputs:out
    }
    over "NG" (
        prepend references = </MaterialX/NodeGraphs/NG>
    )
    {
    }
})"));
}

TEST_F(MtlxLayers, HaveNodesOutsideOfGraphs) {
    const SdfLayerRefPtr layer = open(R"(
  <separate3 name="parts" type="multioutput">
    <input name="in" type="color3" nodename="c"/>
  </separate3>
  <constant name="c" type="color3"><input name="value" type="color3" value="1, 0.5, 0"/></constant>
  <surface_unlit name="S" type="surfaceshader">
    <input name="transmission" type="float" nodename="parts" output="outg"/>
  </surface_unlit>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/>
  </surfacematerial>)");
    EXPECT_EQ(textOf(layer), materialX(R"(
def Shader "parts"
{
    uniform token info:id = "ND_separate3_color3"
    color3f inputs:in.connect = </MaterialX/NodeGraphs/c.outputs:out>
    float outputs:outg
}
def Shader "c"
{
    uniform token info:id = "ND_constant_color3"
    color3f inputs:value = (1, 0.5, 0)
    color3f outputs:out
})",
                                       R"(
def Material "M"
{
    token outputs:mtlx:surface.connect = </MaterialX/Materials/M/S.outputs:out>
    def Shader "S"
    {
        uniform token info:id = "ND_surface_unlit"
        float inputs:transmission.connect = </MaterialX/Materials/M/NodeGraphs/parts.outputs:outg>
        token outputs:out
    }
    over "NodeGraphs" (
        prepend references = </MaterialX/NodeGraphs>
    )
    {
    }
})"));
}

TEST_F(MtlxLayers, ExpandNodesThatTheDocumentDefines) {
    const SdfLayerRefPtr layer = open(R"(
  <nodedef name="ND_tint" node="tint">
    <input name="amount" type="float" value="0.5"/>
    <output name="out" type="color3"/>
  </nodedef>
  <nodedef name="ND_tint_float" node="tint"><output name="out" type="float"/></nodedef>
  <nodegraph name="NG_tint" nodedef="ND_tint">
    <multiply name="m" type="color3">
      <input name="in1" type="color3" value="1,0,0"/>
      <input name="in2" type="float" interfacename="amount"/>
    </multiply>
    <output name="out" type="color3" nodename="m"/>
  </nodegraph>
  <tint name="t" type="color3"><input name="amount" type="float" value="0.25"/></tint>
  <tint name="f" type="float"/>)");
    EXPECT_EQ(textOf(layer), materialX(R"(
def NodeGraph "ND_tint"
{
    float inputs:amount = 0.5
    color3f outputs:out.connect = </MaterialX/NodeGraphs/ND_tint/m.outputs:out>
    def Shader "m"
    {
        uniform token info:id = "ND_multiply_color3FA"
        color3f inputs:in1 = (1, 0, 0)
        float inputs:in2.connect = </MaterialX/NodeGraphs/ND_tint.inputs:amount>
        color3f outputs:out
    }
}
def NodeGraph "t" (
    prepend references = </MaterialX/NodeGraphs/ND_tint>
)
{
    float inputs:amount = 0.25
}
def Shader "f"
{
    uniform token info:id = "ND_tint_float"
    float outputs:out
})"));
}

TEST_F(MtlxLayers, PassInputsThroughGraphs) {
    const SdfLayerRefPtr layer = open(R"(
  <constant name="c" type="float"/>
  <nodegraph name="NG">
    <input name="file" type="filename" value="a.png" colorspace="g22_rec709"/>
    <input name="scale" type="float" nodename="c"/>
    <image name="i" type="color3"><input name="file" type="filename" interfacename="file"/></image>
    <output name="out" type="color3" nodename="i"/>
  </nodegraph>)");
    EXPECT_EQ(textOf(layer), materialX(R"(
def Shader "c"
{
    uniform token info:id = "ND_constant_float"
    float outputs:out
}
def NodeGraph "NG"
{
    asset inputs:file = @a.png@
    float inputs:scale.connect = </MaterialX/NodeGraphs/c.outputs:out>
    color3f outputs:out.connect = </MaterialX/NodeGraphs/NG/i.outputs:out>
    def Shader "i"
    {
        uniform token info:id = "ND_image_color3"
        token inputs:colorSpace:file = "g22_rec709"
        asset inputs:file.connect = </MaterialX/NodeGraphs/NG.inputs:file>
        color3f outputs:out
    }
})"));
}

TEST_F(MtlxLayers, HaveDisplacementsAndVolumes) {
    const SdfLayerRefPtr layer = open(R"(
  <displacement name="D" type="displacementshader">
    <input name="displacement" type="vector3" value="0, 1, 0"/>
    <input name="scale" type="float" value="2"/>
  </displacement>
  <volume name="V" type="volumeshader"/>
  <surfacematerial name="M" type="material">
    <input name="displacementshader" type="displacementshader" nodename="D"/>
  </surfacematerial>
  <volumematerial name="N" type="material">
    <input name="volumeshader" type="volumeshader" nodename="V"/>
  </volumematerial>)");
    EXPECT_EQ(textOf(layer), materialX("", R"(
def Material "M"
{
    float3 inputs:displacement = (0, 1, 0)
    float inputs:scale = 2
    token outputs:mtlx:displacement.connect = </MaterialX/Materials/M/D.outputs:out>
    def Shader "D"
    {
        uniform token info:id = "ND_displacement_vector3"
        float3 inputs:displacement.connect = </MaterialX/Materials/M.inputs:displacement>
        float inputs:scale.connect = </MaterialX/Materials/M.inputs:scale>
        token outputs:out
    }
}
def Material "N"
{
    token outputs:mtlx:volume.connect = </MaterialX/Materials/N/V.outputs:out>
    def Shader "V"
    {
        uniform token info:id = "ND_volume"
        token outputs:out
    }
})"));
}

/// Up to 1.37: parameters beside inputs, and shaders as references within materials.
TEST_F(MtlxLayers, ReadTheMaterialsOfOldVersions) {
    const SdfLayerRefPtr layer = open(R"(
  <nodegraph name="NG">
    <image name="i" type="color3"><parameter name="file" type="filename" value="a.png"/></image>
    <output name="o" type="color3" nodename="i"/>
  </nodegraph>
  <material name="M">
    <shaderref name="S" node="standard_surface">
      <bindinput name="base_color" type="color3" nodegraph="NG" output="o"/>
      <bindinput name="base" type="float" value="0.9"/>
    </shaderref>
  </material>)",
                                      R"(version="1.36")");
    EXPECT_EQ(textOf(layer), materialX(R"(
def NodeGraph "NG"
{
    color3f outputs:o.connect = </MaterialX/NodeGraphs/NG/i.outputs:out>
    def Shader "i"
    {
        uniform token info:id = "ND_image_color3"
        asset inputs:file = @a.png@
        color3f outputs:out
    }
})",
                                       R"(
def Material "M"
{
    float inputs:base = 0.9
    token outputs:mtlx:surface.connect = </MaterialX/Materials/M/S.outputs:out>
    def Shader "S"
    {
        uniform token info:id = "ND_standard_surface_surfaceshader"
        float inputs:base.connect = </MaterialX/Materials/M.inputs:base>
        color3f inputs:base_color.connect = </MaterialX/Materials/M/NG.outputs:o>
        token outputs:out
    }
    over "NG" (
        prepend references = </MaterialX/NodeGraphs/NG>
    )
    {
    }
})"));
}

TEST_F(MtlxLayers, HaveValuesOfEveryType) {
    EXPECT_EQ(value("float", " 0.25 "), VtValue(0.25f));
    EXPECT_EQ(value("float", "1e-3"), VtValue(1e-3f));
    EXPECT_EQ(value("integer", "-3"), VtValue(-3));
    EXPECT_EQ(value("boolean", "true"), VtValue(true));
    EXPECT_EQ(value("boolean", "false"), VtValue(false));
    EXPECT_EQ(value("color3", "1,0.5, 0"), VtValue(GfVec3f(1, 0.5f, 0)));
    EXPECT_EQ(value("color4", "1 0 0 0.5"), VtValue(GfVec4f(1, 0, 0, 0.5f)));
    EXPECT_EQ(value("vector2", "1,2"), VtValue(GfVec2f(1, 2)));
    EXPECT_EQ(value("vector3", "1,2,3"), VtValue(GfVec3f(1, 2, 3)));
    EXPECT_EQ(value("matrix33", "1,2,3, 4,5,6, 7,8,9"), VtValue(GfMatrix3d(1, 2, 3, 4, 5, 6, 7, 8, 9)));
    EXPECT_EQ(value("string", "a, b"), VtValue(std::string("a, b")));
    EXPECT_EQ(value("filename", "a b.png"), VtValue(SdfAssetPath("a b.png")));
    EXPECT_EQ(value("floatarray", "1, 2, 3"), VtValue(VtFloatArray{1, 2, 3}));
    EXPECT_EQ(value("vector2array", "1, 2, 3, 4"), VtValue(VtArray<GfVec2f>{{1, 2}, {3, 4}}));
    EXPECT_EQ(value("stringarray", "a, b c"), VtValue(VtStringArray{"a", "b c"}));
}

TEST_F(MtlxLayers, InheritPrefixesAndColourSpaces) {
    const SdfLayerRefPtr layer = open(R"(
  <image name="a" type="color3"><input name="file" type="filename" value="a.png"/></image>
  <image name="b" type="color3" fileprefix="other/" colorspace="acescg">
    <input name="file" type="filename" value="b.png"/>
    <input name="default" type="color3" value="1,1,1"/>
  </image>
  <image name="c" type="vector3"><input name="file" type="filename" value="/c.png" colorspace="acescg"/></image>)",
                                      R"(version="1.38" fileprefix="tex/" colorspace="srgb_texture")");
    EXPECT_EQ(textOf(layer), materialX(R"(
def Shader "a"
{
    uniform token info:id = "ND_image_color3"
    token inputs:colorSpace:file = "srgb_texture"
    asset inputs:file = @tex/a.png@ (
        colorSpace = "srgb_texture"
    )
    color3f outputs:out
}
def Shader "b"
{
    uniform token info:id = "ND_image_color3"
    token inputs:colorSpace:default = "acescg"
    token inputs:colorSpace:file = "acescg"
    color3f inputs:default = (1, 1, 1) (
        colorSpace = "acescg"
    )
    asset inputs:file = @other/b.png@ (
        colorSpace = "acescg"
    )
    color3f outputs:out
}
def Shader "c"
{
    uniform token info:id = "ND_image_vector3"
    asset inputs:file = @/c.png@
    float3 outputs:out
})"));
}

TEST_F(MtlxLayers, IncludeOtherDocuments) {
    file("lib/nodes.mtlx", R"(<materialx version="1.38" namespace="lib" fileprefix="tex/">
  <xi:include href="more.mtlx"/>
  <image name="i" type="float"><input name="file" type="filename" value="i.png"/></image>
  <add name="sum" type="float"><input name="in1" type="float" nodename="i"/>
    <input name="in2" type="float" nodename="more"/></add>
</materialx>)");
    file("lib/more.mtlx", R"(<materialx version="1.38"><constant name="more" type="float"/></materialx>)");
    const SdfLayerRefPtr layer = open(R"(
  <xi:include href="lib/nodes.mtlx"/>
  <absval name="a" type="float"><input name="in" type="float" nodename="lib:sum"/></absval>)");
    EXPECT_EQ(textOf(layer), materialX(R"(
def Shader "lib_more"
{
    uniform token info:id = "ND_constant_float"
    float outputs:out
}
def Shader "lib_i"
{
    uniform token info:id = "ND_image_float"
    asset inputs:file = @lib/tex/i.png@
    float outputs:out
}
def Shader "lib_sum"
{
    uniform token info:id = "ND_add_float"
    float inputs:in1.connect = </MaterialX/NodeGraphs/lib_i.outputs:out>
    float inputs:in2.connect = </MaterialX/NodeGraphs/lib_more.outputs:out>
    float outputs:out
}
def Shader "a"
{
    uniform token info:id = "ND_absval_float"
    float inputs:in.connect = </MaterialX/NodeGraphs/lib_sum.outputs:out>
    float outputs:out
})"));
}

/// What a stage sees that refers to the materials of a document, as UsdImaging asks for it.
TEST_F(MtlxLayers, ComposeInStages) {
    open(R"(
  <nodedef name="ND_twice" node="twice">
    <input name="in" type="float" value="1"/><output name="out" type="float"/>
  </nodedef>
  <nodegraph name="NG_twice" nodedef="ND_twice">
    <multiply name="m" type="float">
      <input name="in1" type="float" interfacename="in"/><input name="in2" type="float" value="2"/>
    </multiply>
    <output name="out" type="float" nodename="m"/>
  </nodegraph>
  <nodegraph name="NG">
    <constant name="c" type="float"/>
    <twice name="t" type="float"><input name="in" type="float" nodename="c"/></twice>
    <output name="out" type="float" nodename="t"/>
  </nodegraph>
  <standard_surface name="S" type="surfaceshader">
    <input name="base" type="float" nodegraph="NG" output="out"/>
    <input name="metalness" type="float" value="0.5"/>
  </standard_surface>
  <surfacematerial name="M" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="S"/>
  </surfacematerial>)");
    const UsdStageRefPtr stage = UsdStage::Open(file("a.usda", R"(#usda 1.0
def Scope "Looks" (
    references = @a.mtlx@</MaterialX/Materials>
)
{
}
)"));
    const UsdShadeMaterial material(stage->GetPrimAtPath(SdfPath("/Looks/M")));
    const UsdShadeShader surface = material.ComputeSurfaceSource(TfToken("mtlx"));
    ASSERT_TRUE(surface);
    EXPECT_EQ(surface.GetPath(), SdfPath("/Looks/M/S"));
    const auto producer = [](UsdShadeShader const& shader, char const* input) {
        UsdShadeAttributeType type{};
        return shader.GetInput(TfToken(input)).GetValueProducingAttribute(&type).GetPath();
    };
    const auto shaderAt = [&](char const* path) {
        return UsdShadeShader(stage->GetPrimAtPath(SdfPath(path)));
    };
    EXPECT_EQ(producer(surface, "metalness"), SdfPath("/Looks/M.inputs:metalness"));
    EXPECT_EQ(producer(surface, "base"), SdfPath("/Looks/M/NG/t/m.outputs:out"));
    EXPECT_EQ(producer(shaderAt("/Looks/M/NG/t/m"), "in1"), SdfPath("/Looks/M/NG/c.outputs:out"));
}

} // namespace
