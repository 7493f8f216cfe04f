/// Hydra material networks -> material descriptions.
#include <gtest/gtest.h>

#include "plugin/hdHipr/materialNetwork.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/imaging/hd/tokens.h"
#include "pxr/usd/sdf/assetPath.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace {

/// A network that grows node by node; the surface is added last, as hosts do.
struct Network {
    HdMaterialNetwork network;

    SdfPath path(const char* name) { return SdfPath("/material").AppendChild(TfToken(name)); }
    HdMaterialNode& add(const char* name, const char* identifier) {
        HdMaterialNode node;
        node.path = path(name);
        node.identifier = TfToken(identifier);
        network.nodes.push_back(node);
        return network.nodes.back();
    }
    void connect(const char* from, const char* output, const char* to, const char* input) {
        HdMaterialRelationship link;
        link.inputId = path(from);
        link.inputName = TfToken(output);
        link.outputId = path(to);
        link.outputName = TfToken(input);
        network.relationships.push_back(link);
    }
    std::optional<hipr::MaterialDesc> desc() {
        HdMaterialNetworkMap map;
        map.map[HdMaterialTerminalTokens->surface] = network;
        map.terminals.push_back(network.nodes.back().path);
        return hdhipr::materialDesc(SdfPath("/material"), map);
    }
};

VtValue token(const char* text) {
    return VtValue(TfToken(text));
}

TEST(MaterialNetwork, constantsOfAnyNumberType) {
    Network n;
    auto& p = n.add("surface", "UsdPreviewSurface").parameters;
    p[TfToken("diffuseColor")] = VtValue(GfVec3f(0.1f, 0.2f, 0.3f));
    p[TfToken("roughness")] = VtValue(0.25);
    p[TfToken("useSpecularWorkflow")] = VtValue(1);
    p[TfToken("opacityMode")] = token("presence");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    EXPECT_EQ(glm::vec3(desc->diffuseColor.constant), glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(desc->roughness.constant.x, 0.25f);
    EXPECT_EQ(desc->ior.constant.x, 1.5f);
    EXPECT_TRUE(desc->useSpecularWorkflow);
    EXPECT_EQ(desc->opacityMode, hipr::OpacityMode::Presence);
}

TEST(MaterialNetwork, textureWithReaderAndTransform) {
    Network n;
    n.add("reader", "UsdPrimvarReader_float2").parameters[TfToken("varname")] = token("map1");
    auto& transform = n.add("place", "UsdTransform2d").parameters;
    transform[TfToken("scale")] = VtValue(GfVec2f(2, 3));
    transform[TfToken("rotation")] = VtValue(90.f);
    transform[TfToken("translation")] = VtValue(GfVec2f(0.5f, 0.25f));
    auto& texture = n.add("texture", "UsdUVTexture").parameters;
    texture[TfToken("file")] = VtValue(SdfAssetPath("wood.png", "/textures/wood.png"));
    texture[TfToken("wrapS")] = token("mirror");
    texture[TfToken("sourceColorSpace")] = token("raw");
    texture[TfToken("scale")] = VtValue(GfVec4f(2));
    n.add("surface", "UsdPreviewSurface");
    n.connect("reader", "result", "place", "in");
    n.connect("place", "result", "texture", "st");
    n.connect("texture", "rgb", "surface", "diffuseColor");
    n.connect("texture", "a", "surface", "opacity");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    const hipr::TextureDesc& t = desc->diffuseColor.texture;
    EXPECT_EQ(desc->diffuseColor.source, hipr::MaterialInput::Source::Texture);
    EXPECT_EQ(desc->diffuseColor.channel, hipr::Channel::Rgb);
    EXPECT_EQ(desc->opacity.channel, hipr::Channel::A);
    EXPECT_EQ(t.path, "/textures/wood.png");
    EXPECT_EQ(t.wrapS, hipr::WrapMode::Mirror);
    EXPECT_EQ(t.wrapT, hipr::WrapMode::UseMetadata);
    EXPECT_EQ(t.colorSpace, "raw");
    EXPECT_EQ(t.scale, glm::vec4(2));
    EXPECT_EQ(t.uvPrimvar, "map1");
    // (1, 1) scaled to (2, 3), turned to (-3, 2), moved.
    const glm::vec2 uv = t.uvTransform * glm::vec3(1, 1, 1);
    EXPECT_NEAR(uv.x, -2.5f, 1e-5f);
    EXPECT_NEAR(uv.y, 2.25f, 1e-5f);
}

TEST(MaterialNetwork, primvarReadersWithTextNames) {
    Network n;
    auto& reader = n.add("reader", "UsdPrimvarReader_float3").parameters;
    reader[TfToken("varname")] = VtValue(std::string("tint"));
    reader[TfToken("fallback")] = VtValue(GfVec3f(1, 0, 0));
    n.add("surface", "UsdPreviewSurface");
    n.connect("reader", "result", "surface", "diffuseColor");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    EXPECT_EQ(desc->diffuseColor.source, hipr::MaterialInput::Source::Primvar);
    EXPECT_EQ(desc->diffuseColor.primvar, "tint");
    EXPECT_EQ(glm::vec3(desc->diffuseColor.constant), glm::vec3(1, 0, 0));
}

TEST(MaterialNetwork, cyclesEnd) {
    Network n;
    n.add("a", "UsdTransform2d");
    n.add("b", "UsdTransform2d");
    n.add("texture", "UsdUVTexture").parameters[TfToken("file")] = VtValue(SdfAssetPath("x.png", "/x.png"));
    n.add("surface", "UsdPreviewSurface");
    n.connect("a", "result", "b", "in");
    n.connect("b", "result", "a", "in");
    n.connect("a", "result", "texture", "st");
    n.connect("texture", "rgb", "surface", "diffuseColor");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    EXPECT_EQ(desc->diffuseColor.texture.uvPrimvar, "");
}

TEST(MaterialNetwork, unknownNodesKeepTheInputsOwnValue) {
    Network n;
    n.add("noise", "SomeNoise");
    n.add("surface", "UsdPreviewSurface").parameters[TfToken("diffuseColor")] = VtValue(GfVec3f(0.5f));
    n.connect("noise", "out", "surface", "diffuseColor");
    n.connect("absent", "out", "surface", "metallic");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    EXPECT_EQ(desc->diffuseColor.source, hipr::MaterialInput::Source::Constant);
    EXPECT_EQ(desc->diffuseColor.constant.x, 0.5f);
}

TEST(MaterialNetwork, openPbrInputsOfEveryKind) {
    Network n;
    auto& texture = n.add("texture", "UsdUVTexture").parameters;
    texture[TfToken("file")] = VtValue(SdfAssetPath("x.png", "/x.png"));
    n.add("reader", "UsdPrimvarReader_float").parameters[TfToken("varname")] = token("wear");
    auto& p = n.add("surface", "ND_open_pbr_surface_surfaceshader").parameters;
    p[TfToken("coat_weight")] = VtValue(0.5f);
    p[TfToken("geometry_thin_walled")] = VtValue(true);
    p[TfToken("unknown_input")] = VtValue(1.f);
    n.connect("texture", "rgb", "surface", "base_color");
    n.connect("texture", "g", "surface", "specular_roughness");
    n.connect("reader", "result", "surface", "base_metalness");
    n.connect("texture", "rgb", "surface", "geometry_coat_normal");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    EXPECT_EQ(desc->model, hipr::MaterialModel::OpenPbr);
    EXPECT_EQ(desc->openPbr.size(), 6u);
    using In = hipr::OpenPbrInput;
    EXPECT_EQ(openPbrInput(*desc, In::CoatWeight).constant.x, 0.5f);
    EXPECT_EQ(openPbrInput(*desc, In::GeometryThinWalled).constant.x, 1.f);
    EXPECT_EQ(openPbrInput(*desc, In::BaseColor).texture.path, "/x.png");
    EXPECT_EQ(openPbrInput(*desc, In::BaseColor).channel, hipr::Channel::Rgb);
    EXPECT_EQ(openPbrInput(*desc, In::SpecularRoughness).channel, hipr::Channel::G);
    EXPECT_EQ(openPbrInput(*desc, In::BaseMetalness).primvar, "wear");
    EXPECT_EQ(openPbrInput(*desc, In::GeometryCoatNormal).source,
              hipr::MaterialInput::Source::Graph); // to world space
    EXPECT_EQ(openPbrInput(*desc, In::CoatIor).constant.x, 1.6f); // the specification's default
}

TEST(MaterialNetwork, patternNodesBecomeAGraph) {
    Network n;
    n.add("position", "ND_position_vector3");
    auto& noise = n.add("noise", "ND_fractal3d_float").parameters;
    noise[TfToken("octaves")] = VtValue(2);
    auto& mix = n.add("mix", "ND_mix_color3").parameters;
    mix[TfToken("fg")] = VtValue(GfVec3f(1, 0, 0));
    mix[TfToken("bg")] = VtValue(GfVec3f(0, 0, 1));
    n.add("surface", "ND_standard_surface_surfaceshader");
    n.connect("position", "out", "noise", "position");
    n.connect("noise", "out", "mix", "mix");
    n.connect("mix", "out", "surface", "base_color");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    EXPECT_EQ(desc->model, hipr::MaterialModel::OpenPbr);
    const hipr::MaterialInput color = openPbrInput(*desc, hipr::OpenPbrInput::BaseColor);
    ASSERT_EQ(color.source, hipr::MaterialInput::Source::Graph);
    const auto value = [&](uint32_t op) {
        for (const hipr::GraphNode& node : desc->graph.nodes) {
            if (node.op == op) {
                return node;
            }
        }
        return hipr::GraphNode();
    };
    EXPECT_EQ(desc->graph.nodes.at(color.node).op, hipr::gpu::GRAPH_MIX);
    EXPECT_EQ(value(hipr::gpu::GRAPH_NOISE).operands[1].constant.x, 2.f);
    EXPECT_EQ(value(hipr::gpu::GRAPH_POSITION).immediate, hipr::gpu::GRAPH_OBJECT);
}

TEST(MaterialNetwork, imagesOfMaterialX) {
    Network n;
    auto& place = n.add("place", "ND_place2d_vector2").parameters;
    place[TfToken("scale")] = VtValue(GfVec2f(0.5f, 0.25f));
    auto& image = n.add("image", "ND_image_color3").parameters;
    image[TfToken("file")] = VtValue(SdfAssetPath("a.png", "/a.png"));
    image[TfToken("uaddressmode")] = VtValue(std::string("mirror"));
    image[TfToken("colorSpace:file")] = token("srgb_texture");
    image[TfToken("default")] = VtValue(GfVec3f(0.5f, 0.25f, 0.125f));
    auto& map = n.add("map", "ND_image_vector3").parameters;
    map[TfToken("file")] = VtValue(SdfAssetPath("n.png", "/n.png"));
    n.add("bumps", "ND_normalmap_float");
    n.add("surface", "ND_standard_surface_surfaceshader");
    n.connect("place", "out", "image", "texcoord");
    n.connect("image", "out", "surface", "base_color");
    n.connect("map", "out", "bumps", "in");
    n.connect("bumps", "out", "surface", "normal");
    const auto desc = n.desc();
    ASSERT_TRUE(desc);
    const hipr::MaterialInput color = openPbrInput(*desc, hipr::OpenPbrInput::BaseColor);
    ASSERT_EQ(color.source, hipr::MaterialInput::Source::Texture);
    EXPECT_EQ(color.texture.path, "/a.png");
    EXPECT_EQ(color.texture.colorSpace, "srgb_texture");
    EXPECT_EQ(color.texture.wrapS, hipr::WrapMode::Mirror);
    EXPECT_EQ(color.texture.wrapT, hipr::WrapMode::Repeat);
    EXPECT_EQ(color.texture.uvPrimvar, "st");
    EXPECT_EQ(glm::vec3(color.texture.fallback), glm::vec3(0.5f, 0.25f, 0.125f));
    EXPECT_EQ(color.texture.uvTransform * glm::vec3(1, 1, 1), glm::vec2(2, 4));
    const hipr::MaterialInput normal = openPbrInput(*desc, hipr::OpenPbrInput::GeometryNormal);
    EXPECT_EQ(normal.source, hipr::MaterialInput::Source::Graph);
    EXPECT_EQ(desc->graph.reads.size(), 3u); // the texture coordinates and two pictures
}

TEST(MaterialNetwork, unknownSurfacesGiveNothing) {
    Network n;
    n.add("surface", "SomeSurface");
    EXPECT_FALSE(n.desc());
    EXPECT_FALSE(hdhipr::materialDesc(SdfPath("/material"), HdMaterialNetworkMap()));
}

} // namespace
