#include <cmath>

#include <glm/gtc/matrix_transform.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/surface_scene.h"

namespace hipr::test {
namespace {

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance,
                const ::testing::Message& where = {}) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], tolerance) << where << " component " << c;
}

/// A diffuse material (specular workflow, no specular): Surface::diffuse is the colour read.
MaterialDesc matte(const MaterialInput& color) {
    MaterialDesc desc;
    desc.name = "/matte";
    desc.diffuseColor = color;
    desc.useSpecularWorkflow = true;
    return desc;
}

SurfaceScene sceneWith(const MaterialDesc& material, Files files = {}) {
    SurfaceScene scene;
    scene.materials = {material};
    scene.files = std::move(files);
    return scene;
}

// 4 x 2 texels, rows from the top; every value is a multiple of 1 / 51.
const std::vector<uint8_t> Checker = {0,  5,  10,  15, 20, 25,  30,  35,  40,  45,  50,  55,
                                      60, 75, 100, 80, 95, 120, 100, 115, 140, 120, 135, 160};

/// Texel of Checker with t upwards, or black outside when `wrap` says so.
glm::vec3 checkerTexel(int x, int y, WrapMode wrap) {
    const auto fold = [&](int i, int n) {
        if (wrap == WrapMode::Repeat) return ((i % n) + n) % n;
        if (wrap == WrapMode::Mirror) {
            i = ((i % (2 * n)) + 2 * n) % (2 * n);
            return i < n ? i : 2 * n - 1 - i;
        }
        if (wrap == WrapMode::Black && (i < 0 || i >= n)) return -1;
        return std::min(std::max(i, 0), n - 1);
    };
    const int column = fold(x, 4), row = fold(y, 2);
    if (column < 0 || row < 0) return glm::vec3(0.f);
    const size_t at = size_t((1 - row) * 4 + column) * 3;
    return glm::vec3(Checker[at], Checker[at + 1], Checker[at + 2]) / 255.f;
}

glm::vec3 checkerLookup(const glm::vec2& st, WrapMode wrap) {
    const double x = double(st.x) * 4.0 - 0.5, y = double(st.y) * 2.0 - 0.5;
    const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
    glm::dvec3 sum(0.0);
    for (int j = 0; j < 2; ++j)
        for (int i = 0; i < 2; ++i)
            sum += (i ? x - x0 : 1.0 - (x - x0)) * (j ? y - y0 : 1.0 - (y - y0)) *
                   glm::dvec3(checkerTexel(x0 + i, y0 + j, wrap));
    return glm::vec3(sum);
}

std::vector<glm::vec2> pointGrid() {
    std::vector<glm::vec2> points;
    for (int i = 0; i < 23; ++i)
        for (int j = 0; j < 19; ++j)
            points.push_back({(float(i) + 0.37f) / 23.f, (float(j) + 0.61f) / 19.f});
    return points;
}

TEST(Texture, BilinearLookupsAndWrapModes) {
    const Files files = {{"a.png", encode8("png", 4, 2, 3, Checker)}};
    const std::vector<glm::vec2> points = pointGrid();
    for (const WrapMode wrap : {WrapMode::Black, WrapMode::Clamp, WrapMode::Repeat, WrapMode::Mirror}) {
        MaterialInput input = textureInput("a.png");
        input.texture.wrapS = input.texture.wrapT = wrap;
        SurfaceScene scene = sceneWith(matte(input), files);
        scene.primvars[0].values = {-2.3f, -1.7f, 3.1f,  -1.7f,
                                    3.1f,  2.9f,  -2.3f, 2.9f}; // st far beyond [0, 1]
        const std::vector<SurfaceOutcome> outcomes = scene.look(points);
        for (size_t i = 0; i < points.size(); ++i) {
            const glm::vec2 st(-2.3f + 5.4f * points[i].x, -1.7f + 4.6f * points[i].y);
            expectNear(outcomes[i].diffuse, checkerLookup(st, wrap), 2e-5f,
                       ::testing::Message() << "wrap " << int(wrap) << " st " << st.x << " " << st.y);
        }
    }
}

TEST(Texture, SrgbIsDecodedBeforeFiltering) {
    const Files files = {{"a.png", encode8("png", 2, 1, 3, {0, 0, 0, 255, 255, 255})}};
    const SurfaceScene scene = sceneWith(matte(textureInput("a.png", Channel::Rgb, "auto")), files);
    expectNear(scene.look({0.5f, 0.5f}).diffuse, glm::vec3(0.5f), 1e-5f);
}

TEST(Texture, HalfAndFloatTexels) {
    for (const float large : {1.f, 1e6f}) {
        const Files files = {{"a.exr", encodeFloat("exr", 2, 1, 3, {0.25f, 0.5f, 0.75f, large, 0.f, 0.f})}};
        const SurfaceScene scene = sceneWith(matte(textureInput("a.exr")), files);
        expectNear(scene.look({0.25f, 0.5f}).diffuse, {0.25f, 0.5f, 0.75f}, 1e-4f);
    }
}

TEST(Texture, TransformScaleBiasAndChannels) {
    const Files files = {{"a.png", encode8("png", 4, 2, 3, Checker)}};
    MaterialInput input = textureInput("a.png");
    input.texture.wrapS = input.texture.wrapT = WrapMode::Repeat;
    input.texture.uvTransform =
        glm::mat3x2(0.f, 2.f, -1.f, 0.f, 0.3f, 0.1f); // turned by 90 degrees, scaled, moved
    input.texture.scale = {0.5f, 2.f, 1.f, 1.f};
    input.texture.bias = {0.1f, -0.1f, 0.f, 0.f};
    const glm::vec2 p(0.2f, 0.7f), st(-p.y + 0.3f, 2.f * p.x + 0.1f);
    const glm::vec3 raw = checkerLookup(st, WrapMode::Repeat);
    const glm::vec3 expected =
        glm::clamp(raw * glm::vec3(0.5f, 2.f, 1.f) + glm::vec3(0.1f, -0.1f, 0.f), 0.f, 1.f);
    expectNear(sceneWith(matte(input), files).look(p).diffuse, expected, 2e-5f);
    for (const auto& [channel, value] : {std::pair(Channel::R, expected.x), std::pair(Channel::G, expected.y),
                                         std::pair(Channel::B, expected.z), std::pair(Channel::A, 1.f)}) {
        input.channel = channel;
        expectNear(sceneWith(matte(input), files).look(p).diffuse, glm::vec3(value), 2e-5f);
    }
}

TEST(Texture, MissingFilesAndPrimvarsFallBack) {
    messageLog().entries.clear();
    MaterialInput input = textureInput("none.png");
    input.texture.fallback = {0.1f, 0.2f, 0.3f, 1.f};
    input.texture.scale = glm::vec4(9.f); // not applied to the fallback
    expectNear(sceneWith(matte(input)).look({0.5f, 0.5f}).diffuse, {0.1f, 0.2f, 0.3f}, 1e-6f);
    EXPECT_EQ(messageLog().count("/matte", "none.png: cannot be read"), 1);
    EXPECT_EQ(messageLog().entries.size(), 1u);

    messageLog().entries.clear();
    expectNear(sceneWith(matte(input), {{"none.png", Bytes(100, 7)}}).look({0.5f, 0.5f}).diffuse,
               {0.1f, 0.2f, 0.3f}, 1e-6f);
    EXPECT_EQ(messageLog().count("/matte", "none.png"), 1);

    messageLog().entries.clear();
    MaterialInput noSt = textureInput("a.png");
    noSt.texture.uvPrimvar = "absent";
    noSt.texture.uvFallback = {0.625f, 0.75f}; // texel (2, 1)
    expectNear(
        sceneWith(matte(noSt), {{"a.png", encode8("png", 4, 2, 3, Checker)}}).look({0.1f, 0.1f}).diffuse,
        checkerTexel(2, 1, WrapMode::Clamp), 1e-5f);
    EXPECT_TRUE(messageLog().entries.empty());
}

TEST(Texture, UdimTilesAreChosenByCoordinate) {
    messageLog().entries.clear();
    const auto tile = [](uint8_t grey) { return encode8("png", 1, 1, 3, {grey, grey, grey}); };
    const Files files = {{"a.1001.png", tile(51)},
                         {"a.1002.png", tile(102)},
                         {"a.1011.png", tile(153)},
                         {"a.1101.png", tile(204)}};
    MaterialInput input = textureInput("a.<UDIM>.png");
    input.texture.fallback = {1.f, 0.f, 1.f, 1.f};
    SurfaceScene scene = sceneWith(matte(input), files);
    const auto at = [&](float s, float t) {
        scene.primvars[0].values = {s, t, s, t, s, t, s, t};
        return scene.look({0.5f, 0.5f}).diffuse;
    };
    expectNear(at(0.99f, 0.01f), glm::vec3(0.2f), 1e-5f);
    expectNear(at(1.01f, 0.99f), glm::vec3(0.4f), 1e-5f);
    expectNear(at(0.5f, 1.5f), glm::vec3(0.6f), 1e-5f);
    expectNear(at(0.5f, 10.5f), glm::vec3(0.8f), 1e-5f); // tile 1101, beyond the first hundred
    expectNear(at(2.5f, 0.5f), {1.f, 0.f, 1.f}, 1e-5f);
    expectNear(at(-0.5f, 0.5f), {1.f, 0.f, 1.f}, 1e-5f);
    expectNear(at(0.5f, 500.f), {1.f, 0.f, 1.f}, 1e-5f);
    EXPECT_TRUE(messageLog().entries.empty());
    input.texture.path = "b.<UDIM>.png";
    expectNear(sceneWith(matte(input), files).look({0.5f, 0.5f}).diffuse, {1.f, 0.f, 1.f}, 1e-5f);
    EXPECT_EQ(messageLog().count("/matte", "b.<UDIM>.png: no tile"), 1);
    messageLog().entries.clear();
}

TEST(PrimvarReader, AllInterpolations) {
    MaterialInput input;
    input.source = MaterialInput::Source::Primvar;
    input.primvar = "paint";
    input.constant = {0.9f, 0.8f, 0.7f, 1.f};
    SurfaceScene scene = sceneWith(matte(input));
    const glm::vec2 p(0.6f, 0.25f);
    expectNear(scene.look(p).diffuse, {0.9f, 0.8f, 0.7f}, 1e-6f);
    const auto with = [&](uint32_t interpolation, uint32_t components, std::vector<float> values) {
        SurfaceScene copy = scene;
        copy.primvars.push_back({"paint", interpolation, components, std::move(values)});
        return copy.look(p).diffuse;
    };
    expectNear(with(gpu::INTERPOLATION_CONSTANT, 3, {0.1f, 0.2f, 0.3f}), {0.1f, 0.2f, 0.3f}, 1e-6f);
    expectNear(with(gpu::INTERPOLATION_UNIFORM, 1, {0.4f, 0.9f}), glm::vec3(0.4f), 1e-6f);
    expectNear(with(gpu::INTERPOLATION_VERTEX, 2, {0, 0, 1, 0, 1, 1, 0, 1}), {0.6f, 0.25f, 0.f}, 1e-6f);
    expectNear(with(gpu::INTERPOLATION_FACE_VARYING, 4,
                    {0, 0, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}),
               {0.6f, 0.25f, 1.f}, 1e-6f);
    scene.primvars.push_back({"paint", gpu::INTERPOLATION_CONSTANT, 3, {0.1f, 0.2f, 0.3f}});
    scene.instancePrimvars.push_back({"paint", gpu::INTERPOLATION_CONSTANT, 3, {0.5f, 0.6f, 0.7f}});
    expectNear(scene.look(p).diffuse, {0.5f, 0.6f, 0.7f}, 1e-6f);
}

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

TEST(Texture, AReaderThatThrowsIsToldOnce) {
    messageLog().entries.clear();
    TextureStore textures(
        testDevice(),
        [](const std::string&) -> std::vector<unsigned char> { throw std::runtime_error("no network"); },
        ColorManager::create({}));
    const uint32_t texture =
        textures.acquire({"a.png", "auto", WrapMode::Clamp, WrapMode::Clamp, true}, "/m");
    EXPECT_TRUE(textures.commit());
    EXPECT_EQ(messageLog().count("/m", "a.png: no network"), 1);
    EXPECT_EQ(textures.image(texture), nullptr);
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
    EXPECT_EQ(reads, 1);
    EXPECT_GE(textureBytes(), before + 256 * 256 * 4);
    EXPECT_LT(textureBytes(), before + 256 * 256 * 4 + 4096);

    materials.set(MaterialId(7), matte(textureInput("a.png"))); // an edit that keeps the texture
    EXPECT_FALSE(textures.commit() && reads > 1);
    EXPECT_TRUE(materials.commit());
    EXPECT_FALSE(materials.commit());
    EXPECT_EQ(reads, 1);
    for (uint32_t i = 1; i <= 100; ++i)
        materials.remove(MaterialId(i));
    textures.commit();
    EXPECT_LT(textureBytes(), before + 4096);
    EXPECT_EQ(materials.index(MaterialId(7)), MaterialTable::Fallback);
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
