/// Surfaces of MaterialX as materials.
#include <map>

#include <gtest/gtest.h>

#include "renderer/materialx/surfaces.h"

namespace hipr::test {
namespace {

using In = OpenPbrInput;

/// A surface node with constants, and one input that a primvar drives.
struct SurfaceNode {
    std::map<std::string, glm::vec4> constants;
    std::string driven;
    std::vector<std::string> told;

    MaterialDesc desc(const std::string& id) {
        GraphBuilder build;
        const auto has = [&](const std::string& name) { return name == driven || constants.count(name) > 0; };
        const MtlxSurface surface{build,
                                  [&](const MtlxInput& in) {
                                      if (in.name == driven)
                                          return mtlxPrimvar(build, "p", 3, GraphValue(0.f));
                                      return GraphValue(has(in.name) ? constants.at(in.name) : in.value);
                                  },
                                  [&](const char* name) { return has(name); },
                                  [](const char*) { return std::string(); },
                                  [&](const std::string& text) { told.push_back(text); }};
        MaterialDesc desc;
        EXPECT_TRUE(mtlxSurface(id, surface, desc)) << id;
        return desc;
    }
};

float number(const MaterialDesc& desc, In which) {
    const MaterialInput input = openPbrInput(desc, which);
    EXPECT_EQ(input.source, MaterialInput::Source::Constant);
    return input.constant.x;
}

const char* const Standard = "ND_standard_surface_surfaceshader";
const char* const Gltf = "ND_gltf_pbr_surfaceshader";

TEST(MtlxSurfaces, StandardSurfaceByDefault) {
    const MaterialDesc desc = SurfaceNode().desc(Standard);
    EXPECT_EQ(desc.model, MaterialModel::OpenPbr);
    EXPECT_EQ(number(desc, In::BaseWeight) * number(desc, In::BaseColor), 0.8f);
    EXPECT_EQ(number(desc, In::SpecularRoughness), 0.2f);
    EXPECT_EQ(number(desc, In::SpecularWeight), 1.f);
    EXPECT_EQ(number(desc, In::ThinFilmWeight), 0.f);
    EXPECT_EQ(number(desc, In::GeometryOpacity), 1.f); // exactly: else shadow rays look again
    EXPECT_EQ(number(desc, In::EmissionLuminance), 0.f);
    EXPECT_EQ(number(desc, In::CoatIor), 1.5f);
    EXPECT_TRUE(desc.graph.nodes.empty());
    const MaterialDesc first = SurfaceNode().desc("ND_standard_surface_surfaceshader_100");
    EXPECT_EQ(number(first, In::BaseWeight), 0.8f);
    EXPECT_EQ(number(first, In::BaseColor), 1.f);
}

TEST(MtlxSurfaces, StandardSurfaceArithmetic) {
    SurfaceNode node;
    node.constants = {{"metalness", glm::vec4(0.25f)},
                      {"specular", glm::vec4(0.2f)},
                      {"thin_film_thickness", glm::vec4(550.f)},
                      {"opacity", glm::vec4(0.2f, 0.3f, 0.7f, 0.f)},
                      {"subsurface_radius", glm::vec4(4.f, 2.f, 1.f, 0.f)},
                      {"subsurface_scale", glm::vec4(0.5f)},
                      {"transmission_dispersion", glm::vec4(30.f)},
                      {"specular_rotation", glm::vec4(0.25f)},
                      {"transmission_extra_roughness", glm::vec4(0.5f)}};
    const MaterialDesc desc = node.desc(Standard);
    EXPECT_NEAR(number(desc, In::SpecularWeight), 0.2f * 0.75f + 0.25f, 1e-6f);
    EXPECT_EQ(number(desc, In::ThinFilmWeight), 1.f);
    EXPECT_NEAR(number(desc, In::ThinFilmThickness), 0.55f, 1e-6f);
    EXPECT_NEAR(number(desc, In::GeometryOpacity), 0.4f, 1e-6f);
    EXPECT_EQ(number(desc, In::SubsurfaceRadius), 2.f);
    EXPECT_EQ(glm::vec3(openPbrInput(desc, In::SubsurfaceRadiusScale).constant), glm::vec3(1.f, 0.5f, 0.25f));
    EXPECT_EQ(number(desc, In::TransmissionDispersionScale), 1.f);
    EXPECT_EQ(number(desc, In::TransmissionDispersionAbbeNumber), 30.f);
    const MaterialInput tangent = openPbrInput(desc, In::GeometryTangent);
    ASSERT_EQ(tangent.source, MaterialInput::Source::Graph);
    EXPECT_EQ(desc.graph.nodes.at(tangent.node).op, gpu::GRAPH_ROTATE);
    EXPECT_EQ(desc.graph.nodes.at(tangent.node).operands[1], GraphValue(90.f));
    EXPECT_EQ(openPbrInput(desc, In::GeometryCoatTangent).source, MaterialInput::Source::Constant);
    EXPECT_EQ(node.told, std::vector<std::string>{"input 'transmission_extra_roughness' has no effect"});
}

TEST(MtlxSurfaces, ArithmeticOnWhatDrivesAnInputIsAGraph) {
    SurfaceNode node;
    node.driven = "metalness";
    const MaterialDesc desc = node.desc(Standard);
    EXPECT_EQ(openPbrInput(desc, In::BaseMetalness).source, MaterialInput::Source::Primvar);
    EXPECT_EQ(number(desc, In::SpecularWeight), 1.f); // 1 whatever the metalness
    node.constants["specular"] = glm::vec4(0.5f);
    const MaterialDesc dim = node.desc(Standard);
    const MaterialInput weight = openPbrInput(dim, In::SpecularWeight);
    ASSERT_EQ(weight.source, MaterialInput::Source::Graph);
    EXPECT_EQ(dim.graph.nodes.at(weight.node).op, gpu::GRAPH_MIX);
}

TEST(MtlxSurfaces, GltfPbr) {
    SurfaceNode node;
    node.constants = {{"metallic", glm::vec4(0.f)},
                      {"sheen_color", glm::vec4(0.2f, 0.4f, 0.1f, 0.f)},
                      {"iridescence", glm::vec4(0.5f)},
                      {"alpha", glm::vec4(0.3f)},
                      {"alpha_mode", glm::vec4(2.f)}};
    MaterialDesc desc = node.desc(Gltf);
    EXPECT_NEAR(number(desc, In::FuzzWeight), 0.4f, 1e-6f);
    EXPECT_EQ(glm::vec3(openPbrInput(desc, In::FuzzColor).constant), glm::vec3(0.5f, 1.f, 0.25f));
    EXPECT_NEAR(number(desc, In::ThinFilmThickness), 0.1f, 1e-6f);
    EXPECT_EQ(number(desc, In::GeometryOpacity), 0.3f);
    node.constants["alpha_mode"] = glm::vec4(1.f);
    EXPECT_EQ(number(node.desc(Gltf), In::GeometryOpacity), 0.f);
    node.constants["alpha_mode"] = glm::vec4(0.f);
    EXPECT_EQ(number(node.desc(Gltf), In::GeometryOpacity), 1.f);
    node.constants["transmission"] = glm::vec4(1.f);
    node.constants["base_color"] = glm::vec4(0.5f);
    desc = node.desc(Gltf);
    EXPECT_EQ(number(desc, In::GeometryThinWalled), 1.f);
    EXPECT_EQ(number(desc, In::TransmissionColor), 0.5f);
    node.constants["attenuation_distance"] = glm::vec4(2.f);
    node.constants["attenuation_color"] = glm::vec4(0.25f);
    desc = node.desc(Gltf);
    EXPECT_EQ(number(desc, In::GeometryThinWalled), 0.f);
    EXPECT_EQ(number(desc, In::TransmissionDepth), 2.f);
    EXPECT_EQ(number(desc, In::TransmissionColor), 0.25f);
}

TEST(MtlxSurfaces, PreviewSurfaceOfMaterialX) {
    SurfaceNode node;
    node.constants = {{"diffuseColor", glm::vec4(0.1f, 0.2f, 0.3f, 0.f)}, {"opacityMode", glm::vec4(1.f)}};
    node.driven = "roughness";
    const MaterialDesc desc = node.desc("ND_UsdPreviewSurface_surfaceshader");
    EXPECT_EQ(desc.model, MaterialModel::UsdPreviewSurface);
    EXPECT_EQ(glm::vec3(desc.diffuseColor.constant), glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(desc.opacityMode, OpacityMode::Presence);
    EXPECT_EQ(desc.roughness.source, MaterialInput::Source::Primvar);
}

TEST(MtlxSurfaces, UnlitSurfacesOnlyEmit) {
    SurfaceNode node;
    node.constants = {{"emission_color", glm::vec4(0.5f)}, {"opacity", glm::vec4(0.5f)}};
    const MaterialDesc desc = node.desc("ND_surface_unlit");
    EXPECT_EQ(number(desc, In::BaseWeight), 0.f);
    EXPECT_EQ(number(desc, In::EmissionLuminance), 1.f);
    EXPECT_EQ(number(desc, In::GeometryOpacity), 0.5f);
}

} // namespace
} // namespace hipr::test
