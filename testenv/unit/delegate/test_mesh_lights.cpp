/// Materials of meshes that UsdLux makes lights. (OpenUSD 20.08 has no such meshes; what makes lights of them
/// is tested as far as it is ours.)
#include <gtest/gtest.h>

#include "plugin/hdHipr/meshLight.h"

PXR_NAMESPACE_USING_DIRECTIVE

using hdhipr::MeshLight;
using hdhipr::shiningMaterial;
using hipr::MaterialDesc;
using hipr::MaterialInput;
using hipr::OpenPbrInput;

namespace {

const glm::vec3 radiance(2.f, 4.f, 8.f);

MeshLight light(MeshLight::Sync sync) {
    return {sync, radiance, false, {}, {}};
}

MaterialInput constant(glm::vec3 const& value) {
    MaterialInput input;
    input.constant = glm::vec4(value, 1.f);
    return input;
}

glm::vec3 rgb(MaterialInput const& input) {
    return glm::vec3(input.constant);
}

TEST(MeshLightMaterial, glowTintsTheLight) {
    MaterialDesc base;
    base.diffuseColor = constant({0.1f, 0.2f, 0.3f});
    base.emissiveColor = constant({0.5f, 0.5f, 0.25f});
    const MaterialDesc made = shiningMaterial(base, light(MeshLight::Sync::GlowTintsLight));
    EXPECT_EQ(rgb(made.emissiveColor), glm::vec3(1.f, 2.f, 2.f));
    EXPECT_EQ(rgb(made.diffuseColor), rgb(base.diffuseColor));
    base.emissiveColor = constant(glm::vec3(0.f));
    EXPECT_EQ(rgb(shiningMaterial(base, light(MeshLight::Sync::GlowTintsLight)).emissiveColor),
              glm::vec3(0.f))
        << "what does not glow gives no light";
}

TEST(MeshLightMaterial, glowOfAnyKindIsScaled) {
    MaterialDesc base;
    base.emissiveColor.source = MaterialInput::Source::Texture;
    base.emissiveColor.texture.scale = glm::vec4(2.f);
    base.emissiveColor.texture.fallback = glm::vec4(1.f);
    const MaterialDesc textured = shiningMaterial(base, light(MeshLight::Sync::GlowTintsLight));
    EXPECT_EQ(glm::vec3(textured.emissiveColor.texture.scale), 2.f * radiance);
    EXPECT_EQ(glm::vec3(textured.emissiveColor.texture.fallback), radiance);

    base.emissiveColor.source = MaterialInput::Source::Primvar;
    base.emissiveColor.primvar = "glow";
    const MaterialDesc primvar = shiningMaterial(base, light(MeshLight::Sync::GlowTintsLight));
    ASSERT_EQ(primvar.emissiveColor.source, MaterialInput::Source::Graph);
    ASSERT_EQ(primvar.graph.nodes.size(), 2u);
    EXPECT_EQ(primvar.graph.reads.at(0).primvar, "glow");
    EXPECT_EQ(primvar.graph.nodes[0].op, hipr::gpu::GRAPH_READ);
    EXPECT_EQ(primvar.graph.nodes[1].op, hipr::gpu::GRAPH_MULTIPLY);
    EXPECT_EQ(primvar.graph.nodes[1].operands[0].node, 0u);
    EXPECT_EQ(glm::vec3(primvar.graph.nodes[1].operands[1].constant), radiance);

    const MaterialDesc again = shiningMaterial(primvar, light(MeshLight::Sync::GlowTintsLight));
    ASSERT_EQ(again.graph.nodes.size(), 3u) << "a graph gets a node more";
    EXPECT_EQ(again.graph.nodes[2].operands[0].node, 1u);
    EXPECT_EQ(again.emissiveColor.node, 2u);
}

TEST(MeshLightMaterial, openPbrKeepsItsLuminance) {
    MaterialDesc base;
    base.model = hipr::MaterialModel::OpenPbr;
    base.openPbr[OpenPbrInput::EmissionLuminance] = constant(glm::vec3(100.f));
    const MaterialDesc tinted = shiningMaterial(base, light(MeshLight::Sync::GlowTintsLight));
    EXPECT_EQ(rgb(tinted.openPbr.at(OpenPbrInput::EmissionColor)), radiance)
        << "the colour's default is white";
    EXPECT_EQ(tinted.openPbr.at(OpenPbrInput::EmissionLuminance),
              base.openPbr.at(OpenPbrInput::EmissionLuminance));
    const MaterialDesc own = shiningMaterial(base, light(MeshLight::Sync::Independent));
    EXPECT_EQ(rgb(own.openPbr.at(OpenPbrInput::EmissionLuminance)), glm::vec3(1.f));
    EXPECT_EQ(rgb(own.openPbr.at(OpenPbrInput::EmissionColor)), radiance);
}

TEST(MeshLightMaterial, independentAndBareOnesEmitTheLightsOwn) {
    MaterialDesc base;
    base.emissiveColor = constant(glm::vec3(7.f));
    base.diffuseColor = constant(glm::vec3(0.9f));
    const MaterialDesc independent = shiningMaterial(base, light(MeshLight::Sync::Independent));
    EXPECT_EQ(rgb(independent.emissiveColor), radiance);
    EXPECT_EQ(rgb(independent.diffuseColor), glm::vec3(0.9f));
    const MaterialDesc pure = shiningMaterial(base, light(MeshLight::Sync::NoResponse));
    EXPECT_EQ(rgb(pure.emissiveColor), radiance);
    EXPECT_EQ(rgb(pure.diffuseColor), glm::vec3(0.f));
    const MaterialDesc bare = shiningMaterial(std::nullopt, light(MeshLight::Sync::GlowTintsLight));
    EXPECT_EQ(rgb(bare.emissiveColor), radiance);
    EXPECT_EQ(bare.diffuseColor.primvar, "displayColor");
}

TEST(MeshLightMaterial, followsWhatItIsMadeOf) {
    hdhipr::ShiningMaterials materials;
    hipr::SceneEdit edit;
    const auto emitted = [&edit] {
        const std::vector<hipr::SceneEdit::Op> ops = edit.take();
        const auto* op = ops.empty() ? nullptr : std::get_if<hipr::SceneEdit::MaterialOp>(&ops.back());
        return op && op->desc ? rgb(op->desc->emissiveColor).x : -1.f;
    };
    MaterialDesc base;
    base.emissiveColor = constant(glm::vec3(1.f));
    materials.set(hipr::MaterialId(7), SdfPath("/m"), base, light(MeshLight::Sync::GlowTintsLight), edit);
    EXPECT_EQ(emitted(), 2.f);
    base.emissiveColor = constant(glm::vec3(3.f));
    materials.baseChanged(SdfPath("/other"), base, edit);
    EXPECT_EQ(emitted(), -1.f);
    materials.baseChanged(SdfPath("/m"), base, edit);
    EXPECT_EQ(emitted(), 6.f);
    materials.remove(hipr::MaterialId(7), edit);
    edit.clear();
    materials.baseChanged(SdfPath("/m"), base, edit);
    EXPECT_TRUE(edit.empty());
}

TEST(MeshLightMaterial, areaIsThatInTheWorld) {
    hipr::TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_NEAR(hdhipr::worldArea(mesh, GfMatrix4d(1.0)), 1.0, 1e-6);
    EXPECT_NEAR(hdhipr::worldArea(mesh, GfMatrix4d().SetScale(GfVec3d(2, 3, 5))), 6.0, 1e-6);
}

} // namespace
