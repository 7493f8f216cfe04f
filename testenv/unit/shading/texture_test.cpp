// Textures and primvars as materials read them.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/surface_scene.h"

namespace hipr::test {
namespace {

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

} // namespace
} // namespace hipr::test
