#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/surface_scene.h"

namespace hipr::test {
namespace {

TEST(FallbackLook, ShowsDisplayColorAndOpacity) {
    SurfaceScene scene;
    expectNear(scene.look({0.5f, 0.5f}).diffuse, glm::vec3(0.18f), 1e-6f);
    EXPECT_EQ(scene.look({0.5f, 0.5f}).opacity, 1.f);
    scene.primvars.push_back(
        {"displayColor", gpu::INTERPOLATION_VERTEX, 3, {1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 1}});
    scene.instancePrimvars.push_back({"displayOpacity", gpu::INTERPOLATION_CONSTANT, 1, {0.25f}});
    const SurfaceOutcome s = scene.look({0.3f, 0.5f});
    expectNear(s.diffuse, {0.5f, 0.f, 0.5f}, 1e-6f);
    EXPECT_EQ(s.opacity, 0.25f);
    EXPECT_EQ(s.presence, 0.25f);
}

TEST(Materials, SlotsPickTheirMaterial) {
    SurfaceScene scene;
    scene.materials = {matte(constantInput(glm::vec3(0.1f))), matte(constantInput(glm::vec3(0.2f)))};
    scene.slots = {0, 1};
    expectNear(scene.look({0.7f, 0.2f}).diffuse, glm::vec3(0.1f), 1e-6f);
    expectNear(scene.look({0.2f, 0.7f}).diffuse, glm::vec3(0.2f), 1e-6f);
    scene.slots = {7, 0}; // beyond the last: the last
    expectNear(scene.look({0.7f, 0.2f}).diffuse, glm::vec3(0.2f), 1e-6f);
}

TEST(Materials, InputsReachTheirLobes) {
    MaterialDesc desc;
    desc.diffuseColor = constantInput(glm::vec3(0.5f, 0.4f, 0.3f));
    desc.metallic = constantInput(0.25f);
    desc.roughness = constantInput(0.6f);
    desc.clearcoat = constantInput(0.7f);
    desc.clearcoatRoughness = constantInput(0.2f);
    desc.ior = constantInput(2.f);
    desc.emissiveColor = constantInput(glm::vec3(3.f, 2.f, 1.f));
    const SurfaceOutcome s = sceneWith(desc).look({0.5f, 0.5f});
    expectNear(s.diffuse, glm::vec3(0.5f, 0.4f, 0.3f) * 0.75f, 1e-6f);
    expectNear(s.f0, glm::mix(glm::vec3(1.f / 9.f), glm::vec3(0.5f, 0.4f, 0.3f), 0.25f), 1e-6f);
    expectNear(s.emission, {3.f, 2.f, 1.f}, 1e-6f);
    EXPECT_NEAR(s.alpha, 0.36f, 1e-6f);
    EXPECT_NEAR(s.coat, 0.7f, 1e-6f);
    EXPECT_NEAR(s.coatAlpha, 0.04f, 1e-6f);
    EXPECT_EQ(s.glass, 0.f);
    EXPECT_EQ(s.opacity, 1.f);
    desc.useSpecularWorkflow = true;
    desc.specularColor = constantInput(glm::vec3(0.2f, 0.3f, 0.4f));
    const SurfaceOutcome specular = sceneWith(desc).look({0.5f, 0.5f});
    expectNear(specular.diffuse, {0.5f, 0.4f, 0.3f}, 1e-6f);
    expectNear(specular.f0, {0.2f, 0.3f, 0.4f}, 1e-6f);
}

TEST(Materials, OpacityRules) {
    MaterialDesc desc = matte(constantInput(glm::vec3(0.5f)));
    const auto check = [&](float glass, float opacity, bool nonOpaque, const char* what, Files files = {}) {
        const SurfaceScene scene = sceneWith(desc, std::move(files));
        const SurfaceOutcome s = scene.look({0.5f, 0.5f});
        EXPECT_NEAR(s.glass, glass, 1e-6f) << what;
        EXPECT_NEAR(s.opacity, opacity, 1e-6f) << what;
        EXPECT_NEAR(s.presence, opacity, 1e-6f) << what;
        EXPECT_EQ(scene.nonOpaque(0), nonOpaque) << what;
    };
    check(0.f, 1.f, false, "opaque");
    desc.opacity = constantInput(0.3f);
    check(0.7f, 1.f, false, "refracting");
    desc.ior = constantInput(1.f);
    check(0.f, 0.3f, true, "ior 1 bends nothing");
    desc.ior = constantInput(1.5f);
    desc.opacityMode = OpacityMode::Presence;
    check(0.f, 0.3f, true, "presence");
    desc.opacityMode = OpacityMode::Transparent;
    desc.opacityThreshold = constantInput(0.5f);
    check(0.f, 0.f, true, "cut out");
    desc.opacityThreshold = constantInput(0.2f);
    check(0.f, 1.f, false, "kept by the threshold");

    const Files leaf = {{"leaf.png", encode8("png", 1, 1, 4, {255, 255, 255, 102})},
                        {"solid.png", encode8("png", 1, 1, 4, {255, 255, 255, 255})}};
    desc.opacityThreshold = constantInput(0.f);
    desc.opacity = textureInput("leaf.png", Channel::A);
    check(0.f, 0.4f, true, "textured", leaf);
    desc.opacityThreshold = constantInput(0.5f);
    check(0.f, 0.f, true, "textured cut out", leaf);
    desc.opacity = textureInput("solid.png", Channel::A);
    check(0.f, 1.f, false, "alpha of a picture without transparency", leaf);
}

TEST(Materials, BadValuesAreClampedAndToldOnce) {
    messageLog().entries.clear();
    MaterialDesc desc = matte(constantInput(glm::vec3(0.5f, std::nanf(""), 7.f)));
    desc.roughness = constantInput(-3.f);
    desc.metallic = constantInput(std::numeric_limits<float>::infinity());
    const SurfaceOutcome s = sceneWith(desc).look({0.5f, 0.5f});
    expectNear(s.diffuse, {0.5f, 0.18f, 1.f}, 1e-6f);
    EXPECT_NEAR(s.alpha, 2e-4f, 1e-6f);
    EXPECT_EQ(messageLog().count("/matte", "clamped: diffuseColor, metallic, roughness"), 1);
    EXPECT_EQ(messageLog().entries.size(), 1u);
    messageLog().entries.clear();
}

TEST(Materials, TexturesAreSharedAndFreed) {
    int reads = 0;
    const Bytes picture = encode8("png", 256, 256, 3, std::vector<uint8_t>(256 * 256 * 3, 90));
    TextureStore textures(
        testDevice(),
        [&](const std::string&) {
            ++reads;
            return picture;
        },
        ColorManager::create({}));
    NameTable names;
    MaterialTable materials(testDevice(), names, textures);
    const auto textureBytes = [] {
        for (const MemoryReport::Row& row : testDevice().memory().rows)
            if (row.kind == "textures") return row.bytes;
        return uint64_t(0);
    };
    textures.commit();
    const uint64_t before = textureBytes();
    MaterialInput repeat = textureInput("a.png");
    repeat.texture.wrapS = WrapMode::Repeat;
    for (uint32_t i = 1; i <= 100; ++i)
        materials.set(MaterialId(i), matte(i % 2 ? textureInput("a.png") : repeat));
    EXPECT_TRUE(textures.commit());
    EXPECT_TRUE(materials.commit());
    EXPECT_EQ(reads, 2);                                 // for its size, then for its texels
    const uint64_t levels = (256 * 256 * 4 * 4 - 4) / 3; // 256 x 256, 128 x 128, ..., 1 x 1
    EXPECT_GE(textureBytes(), before + levels);
    EXPECT_LT(textureBytes(), before + levels + 4096);

    materials.set(MaterialId(7), matte(textureInput("a.png"))); // an edit that keeps the texture
    EXPECT_FALSE(textures.commit() && reads > 2);
    EXPECT_TRUE(materials.commit());
    EXPECT_FALSE(materials.commit());
    EXPECT_EQ(reads, 2);
    for (uint32_t i = 1; i <= 100; ++i)
        materials.remove(MaterialId(i));
    textures.commit();
    EXPECT_LT(textureBytes(), before + 4096);
    EXPECT_EQ(materials.index(MaterialId(7)), MaterialTable::Fallback);
}

MaterialDesc openPbrMaterial(const std::vector<std::pair<OpenPbrInput, MaterialInput>>& inputs) {
    MaterialDesc desc;
    desc.name = "/openpbr";
    desc.model = MaterialModel::OpenPbr;
    desc.openPbr.insert(inputs.begin(), inputs.end());
    return desc;
}

TEST(OpenPbrMaterials, InputsReachTheirLobes) {
    using In = OpenPbrInput;
    const SurfaceOutcome standard = sceneWith(openPbrMaterial({})).look({0.5f, 0.5f});
    expectNear(standard.diffuse, glm::vec3(0.8f), 1e-6f);
    EXPECT_NEAR(standard.alpha, 0.09f, 1e-6f);
    EXPECT_NEAR(standard.eta, 1.5f, 1e-5f);
    EXPECT_EQ(standard.coat, 0.f);
    const Files files = {{"a.png", encode8("png", 1, 1, 3, {51, 102, 153})}};
    const SurfaceOutcome s =
        sceneWith(openPbrMaterial({{In::BaseColor, textureInput("a.png")},
                                   {In::TransmissionWeight, textureInput("a.png", Channel::G)},
                                   {In::EmissionLuminance, constantInput(2.f)},
                                   {In::EmissionColor, textureInput("a.png")},
                                   {In::GeometryOpacity, textureInput("a.png", Channel::B)}}),
                  files)
            .look({0.5f, 0.5f});
    expectNear(s.diffuse, {0.2f, 0.4f, 0.6f}, 1e-5f);
    expectNear(s.emission, {0.4f, 0.8f, 1.2f}, 1e-5f);
    EXPECT_NEAR(s.glass, 0.4f, 1e-5f);
    EXPECT_NEAR(s.opacity, 0.6f, 1e-5f);
    EXPECT_NEAR(s.presence, 0.6f, 1e-5f);
}

TEST(OpenPbrMaterials, StretchedHighlightsFollowTheTextureCoordinates) {
    SurfaceScene scene =
        sceneWith(openPbrMaterial({{OpenPbrInput::SpecularRoughnessAnisotropy, constantInput(0.5f)}}));
    scene.primvars[0].values = {0, 0, 0, 1, -1, 1, -1, 0}; // s runs along -y, t along x
    expectNear(scene.look({0.3f, 0.6f}).tangent, {0.f, -1.f, 0.f}, 1e-5f);
    scene.primvars.clear(); // any direction on the surface
    const glm::vec3 tangent = scene.look({0.3f, 0.6f}).tangent;
    EXPECT_NEAR(glm::length(tangent), 1.f, 1e-5f);
    EXPECT_NEAR(tangent.z, 0.f, 1e-5f);
}

/// Rows of both models lie side by side.
TEST(OpenPbrMaterials, ModelsShareATable) {
    SurfaceScene scene;
    scene.materials = {matte(constantInput(glm::vec3(0.1f))), openPbrMaterial({}),
                       matte(constantInput(glm::vec3(0.3f)))};
    scene.slots = {0, 1};
    expectNear(scene.look({0.7f, 0.2f}).diffuse, glm::vec3(0.1f), 1e-6f);
    expectNear(scene.look({0.2f, 0.7f}).diffuse, glm::vec3(0.8f), 1e-6f);
    scene.slots = {2, 2};
    expectNear(scene.look({0.7f, 0.2f}).diffuse, glm::vec3(0.3f), 1e-6f);
}

TEST(OpenPbrMaterials, WhatHasNoEffectIsTold) {
    messageLog().entries.clear();
    MaterialInput bent = openPbrDefault(OpenPbrInput::GeometryCoatNormal);
    bent.constant.x = 0.5f;
    sceneWith(openPbrMaterial({{OpenPbrInput::GeometryCoatNormal, bent},
                               {OpenPbrInput::GeometryTangent, openPbrDefault(OpenPbrInput::GeometryTangent)},
                               {OpenPbrInput::BaseWeight, constantInput(3.f)}}))
        .look({0.5f, 0.5f});
    EXPECT_EQ(messageLog().count("/openpbr", "geometry_coat_normal: it is used from graphs alone"), 1);
    EXPECT_EQ(messageLog().count("/openpbr", "clamped: base_weight"), 1);
    EXPECT_EQ(messageLog().entries.size(), 2u); // geometry_tangent has its default
    messageLog().entries.clear();
}

TEST(Normals, InterpolateTransformAndFaceTheViewer) {
    SurfaceScene scene;
    scene.normals = {glm::vec3(-0.5f, 0, 1), glm::vec3(0.5f, 0, 1), glm::vec3(0.5f, 0, 1),
                     glm::vec3(-0.5f, 0, 1)};
    for (const bool mirrored : {false, true})
        for (const bool back : {false, true}) {
            const glm::mat4 turn = glm::rotate(glm::mat4(1.f), 0.7f, glm::normalize(glm::vec3(1, 2, 3)));
            scene.objectToWorld =
                turn * glm::scale(glm::mat4(1.f), glm::vec3(mirrored ? -2.f : 2.f, 1.f, 0.5f));
            const SurfaceOutcome s = scene.look({0.75f, 0.5f}, back);
            const float side = back ? -1.f : 1.f;
            const glm::vec3 up = glm::vec3(turn * glm::vec4(0, 0, 1, 0));
            expectNear(s.ng, up * side, 1e-5f);
            EXPECT_EQ(s.frontFacing, back ? 0u : 1u) << mirrored;
            const glm::vec3 n =
                glm::transpose(glm::inverse(glm::mat3(scene.objectToWorld))) * glm::vec3(0.25f, 0, 1);
            expectNear(s.ns, glm::normalize(n) * side, 1e-5f);
        }
}

TEST(Normals, BrokenNormalsFallBackToTheFace) {
    SurfaceScene scene;
    const float nan = std::nanf("");
    for (const glm::vec3 bad : {glm::vec3(0.f), glm::vec3(nan), glm::vec3(nan, 0, 1),
                                glm::vec3(std::numeric_limits<float>::infinity(), 0, 0)}) {
        scene.normals.assign(4, bad);
        expectNear(scene.look({0.5f, 0.4f}).ns, {0, 0, 1}, 1e-5f);
    }
    scene.normals.assign(4, glm::vec3(0, 0.1f, -1)); // turned over: turned back
    EXPECT_GT(scene.look({0.5f, 0.4f}).ns.z, 0.9f);
}

TEST(Normals, NormalMapFollowsTheTextureCoordinates) {
    // 128/255, 128/255, 255/255 is flat up to half a step; here the normal leans towards +s.
    const Files files = {{"n.exr", encodeFloat("exr", 1, 1, 3, {0.8f, 0.5f, 0.9f})}};
    MaterialDesc desc = matte(constantInput(glm::vec3(0.5f)));
    desc.normal = textureInput("n.exr");
    desc.normal.texture.wrapS = desc.normal.texture.wrapT = WrapMode::Clamp;
    desc.normal.texture.scale = {2.f, 2.f, 2.f, 1.f};
    desc.normal.texture.bias = {-1.f, -1.f, -1.f, 0.f};
    SurfaceScene scene = sceneWith(desc, files);
    const glm::vec3 leaning = glm::normalize(glm::vec3(0.6f, 0.f, 0.8f));
    expectNear(scene.look({0.3f, 0.6f}).ns, leaning, 2e-3f);
    scene.primvars[0].values = {0, 0, 0, 1, -1, 1, -1, 0}; // s runs along -y, t along x
    expectNear(scene.look({0.3f, 0.6f}).ns, {0.f, -leaning.x, leaning.z}, 2e-3f);
    scene.primvars[0].values = {0, 0, -1, 0, -1, 1, 0, 1}; // mirrored s
    expectNear(scene.look({0.3f, 0.6f}).ns, {-leaning.x, 0.f, leaning.z}, 2e-3f);
    scene.primvars[0].values = {0, 0, 0, 0, 0, 0, 0, 0}; // degenerate: no direction to lean to
    expectNear(scene.look({0.3f, 0.6f}).ns, {0, 0, 1}, 1e-5f);
    scene.primvars[0].values = {0, 0, 1, 0, 1, 1, 0, 1};
    expectNear(scene.look({0.3f, 0.6f}, true).ns, -leaning, 2e-3f); // from the back the bump is a dent
    // A map of the opposite direction must not turn the surface over.
    scene.files = {{"n.exr", encodeFloat("exr", 1, 1, 3, {0.5f, 0.5f, 0.f})}};
    EXPECT_GT(scene.look({0.3f, 0.6f}).ns.z, 0.f);
    scene.files = {{"n.exr", encodeFloat("exr", 1, 1, 3, {0.5f, 0.5f, 0.5f})}}; // no direction at all
    expectNear(scene.look({0.3f, 0.6f}).ns, {0, 0, 1}, 2e-3f);
}

} // namespace
} // namespace hipr::test
