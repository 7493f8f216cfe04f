// Cryptomatte AOVs: whose id each pixel has, and how much of it.
#include <cstring>
#include <gtest/gtest.h>

#include "renderer/api/cryptomatte.h"
#include "testenv/render/scene_kit.h"

using namespace hipr;
using namespace hipr::test;

namespace {

constexpr AovKind Kinds[] = {AovKind::CryptoObject, AovKind::CryptoMaterial, AovKind::CryptoAsset};

/// All ranks of a kind, by pixel.
struct Mattes {
    std::vector<Picture<glm::vec4>> layers;
    float coverage(uint32_t x, uint32_t y, const std::string& name) const {
        float sum = 0;
        for (const auto& layer : layers)
            for (int k = 0; k < 4; k += 2)
                if (layer.at(x, y)[k] == cryptomatteId(name)) sum += layer.at(x, y)[k + 1];
        return sum;
    }
    float sum(uint32_t x, uint32_t y) const {
        float sum = 0;
        for (const auto& layer : layers)
            sum += layer.at(x, y)[1] + layer.at(x, y)[3];
        return sum;
    }
    bool operator==(const Mattes& o) const {
        for (size_t i = 0; i < layers.size(); ++i)
            if (!sameBits(layers[i], o.layers[i])) return false;
        return layers.size() == o.layers.size();
    }
};

std::vector<AovRequest> allLayers() {
    std::vector<AovRequest> aovs{{AovKind::Color, {}}};
    for (const AovKind kind : Kinds)
        for (uint32_t layer = 0; layer < CryptomatteLayers; ++layer)
            aovs.push_back({kind, {}, layer});
    return aovs;
}

Mattes read(Stage& stage, AovKind kind) {
    Mattes mattes;
    for (uint32_t layer = 0; layer < CryptomatteLayers; ++layer) {
        Picture<glm::vec4> picture = stage.color();
        EXPECT_TRUE(
            stage.renderer->readAov({kind, {}, layer}, picture.values.data(), picture.values.size() * 4));
        mattes.layers.push_back(picture);
    }
    return mattes;
}

Settings settingsOf(int samples) {
    Settings settings;
    settings.samples = samples;
    settings.pixelFilter = "box";
    settings.filterWidth = 1;
    settings.maxDepth = 1;
    return settings;
}

MaterialDesc named(MaterialDesc material, const std::string& name) {
    material.name = name;
    return material;
}

/// A camera over a film of `size` pixels a side, one unit each, its left bottom at the origin.
CameraDesc above(float size) {
    CameraDesc camera;
    camera.worldToView = glm::lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0), glm::dvec3(0, 1, 0));
    camera.projection = glm::ortho(0.0, double(size), 0.0, double(size), 1.0, 100.0);
    return camera;
}

/// A quad from (x, y) of the given size.
glm::mat4x3 rect(float x, float y, float width, float height, float z = 0) {
    return placed(scaling(width, height, 1), x + 0.5f * width, y + 0.5f * height, z);
}

/// An object of the scene, with its names.
ObjectId addNamed(Stage& stage, const std::string& name, const std::string& asset,
                  const MaterialDesc& material, const glm::mat4x3& transform) {
    const auto geometry = stage.renderer->newId<GeometryId>();
    const auto bound = stage.renderer->newId<MaterialId>();
    const auto object = stage.renderer->newId<ObjectId>();
    stage.edit.setGeometry(geometry, quadMesh());
    stage.edit.setMaterial(bound, material);
    ObjectDesc desc;
    desc.name = name;
    desc.asset = asset;
    desc.geometry = geometry;
    desc.materials = {bound};
    stage.edit.setObject(object, desc);
    stage.edit.setInstances(object, {{transform}, {}, {}, {}, {}});
    return object;
}

/// Pixel (0, 0): nothing; (1, 0): half /a, half nothing; (2, 0): /a over a quarter /b; (3, 0): through a pane
/// of presence 1/2 at /b.
void addFourPixels(Stage& stage) {
    addNamed(stage, "/set/a", "/set", named(matte({0.5f, 0.5f, 0.5f}), "/looks/grey"),
             rect(1.5f, 0, 1.25f, 1));
    addNamed(stage, "/set/b", "/set", named(matte({1, 0, 0}), "/looks/\"red\" \xc3\xa9"),
             rect(2.75f, 0, 1.25f, 1, -1));
    MaterialDesc pane = named(matte({0, 1, 0}), "/looks/pane");
    pane.opacity = constantValue(0.5f);
    pane.opacityMode = OpacityMode::Presence;
    addNamed(stage, "/pane", "", pane, rect(3, 0, 1, 1, 1));
    stage.add(skyLight());
    stage.edit.setCamera(above(4));
    stage.film(4, 4, allLayers());
}

} // namespace

TEST(Cryptomatte, IdsAreThoseOfTheSpecification) {
    // MurmurHash3_x86_32 of texts whose hashes are widely known; the last id is that of the specification's
    // example.
    EXPECT_EQ(cryptomatteBits("hello"), 0x248bfa47u);
    EXPECT_EQ(cryptomatteBits("hello, world"), 0x149bbb7fu);
    EXPECT_EQ(cryptomatteBits("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
    EXPECT_EQ(cryptomatteBits(""), 0x00800000u) << "the hash is 0, which would be no ordinary number";
    EXPECT_EQ(cryptomatteBits("default"), 0x42c9679fu);
    for (int i = 0; i < 20000; ++i) {
        const float id = cryptomatteId("/object" + std::to_string(i));
        ASSERT_TRUE(std::isnormal(id)) << i;
    }
}

TEST(Cryptomatte, CoversTheShareOfSamples) {
    constexpr int Samples = 64;
    Stage stage(settingsOf(Samples));
    addFourPixels(stage);
    stage.render();
    const Mattes objects = read(stage, AovKind::CryptoObject),
                 materials = read(stage, AovKind::CryptoMaterial), assets = read(stage, AovKind::CryptoAsset);
    const ColorPicture color = stage.color();
    EXPECT_EQ(objects.sum(0, 0), 0.f);
    EXPECT_EQ(objects.layers[0].at(0, 0), glm::vec4(0));
    EXPECT_EQ(objects.coverage(1, 0, "/set/a"), 0.5f) << "samples are stratified: exactly half of them";
    EXPECT_EQ(objects.coverage(2, 0, "/set/a"), 0.75f);
    EXPECT_EQ(objects.coverage(2, 0, "/set/b"), 0.25f);
    EXPECT_NEAR(objects.coverage(3, 0, "/pane"), 0.5f, 0.1f);
    EXPECT_EQ(objects.coverage(3, 0, "/pane") + objects.coverage(3, 0, "/set/b"), 1.f);
    EXPECT_EQ(materials.coverage(2, 0, "/looks/grey"), 0.75f);
    EXPECT_EQ(materials.coverage(2, 0, "/looks/\"red\" \xc3\xa9"), 0.25f);
    EXPECT_EQ(assets.coverage(2, 0, "/set"), 1.f) << "both objects are part of it";
    EXPECT_EQ(assets.coverage(3, 0, "/pane"), objects.coverage(3, 0, "/pane")) << "a part of itself";
    for (uint32_t x = 0; x < 4; ++x) {
        for (const Mattes* mattes : {&objects, &materials, &assets})
            EXPECT_EQ(mattes->sum(x, 0), color.at(x, 0).w) << x;
        const glm::vec4 first = objects.layers[0].at(x, 0);
        EXPECT_GE(first[1], first[3]) << "the largest coverage comes first";
    }
    EXPECT_EQ(stage.renderer->cryptomatteNames(AovKind::CryptoObject),
              (std::vector<std::string>{"/pane", "/set/a", "/set/b"}));
    EXPECT_EQ(stage.renderer->cryptomatteNames(AovKind::CryptoAsset),
              (std::vector<std::string>{"/pane", "/set"}));
    EXPECT_EQ(stage.renderer->cryptomatteNames(AovKind::CryptoMaterial),
              (std::vector<std::string>{"/looks/\"red\" \xc3\xa9", "/looks/grey", "/looks/pane",
                                        CryptomatteNoMaterial}));
}

TEST(Cryptomatte, NoOrderOfWorkShows) {
    std::vector<Mattes> all;
    for (const char* mode : {"uniform", "delta"})
        for (const uint32_t batch : {4u, 1024u, 8192u}) {
            Settings settings = settingsOf(16);
            settings.mode = mode;
            Stage stage(settings, {8, batch});
            addFourPixels(stage);
            stage.render();
            all.push_back(read(stage, AovKind::CryptoObject));
        }
    for (const Mattes& mattes : all)
        EXPECT_TRUE(mattes == all.front());
}

TEST(Cryptomatte, FollowsEdits) {
    const auto fresh = [](bool moved, const std::string& asset) {
        auto stage = std::make_unique<Stage>(settingsOf(16));
        addFourPixels(*stage);
        addNamed(*stage, "/late", asset, matte({1, 1, 1}), rect(moved ? 0.f : 2.f, 2, 1, 1));
        stage->render();
        return stage;
    };
    Stage stage(settingsOf(16));
    addFourPixels(stage);
    const ObjectId late = addNamed(stage, "/late", "/x", matte({1, 1, 1}), rect(2, 2, 1, 1));
    stage.film(4, 4, {{AovKind::Color, {}}});
    stage.render();
    stage.film(4, 4, allLayers()); // asked for when all is there already
    stage.render();
    EXPECT_TRUE(read(stage, AovKind::CryptoAsset) == read(*fresh(false, "/x"), AovKind::CryptoAsset));
    stage.edit.setInstances(late, {{rect(0, 2, 1, 1)}, {}, {}, {}, {}});
    stage.render();
    EXPECT_EQ(read(stage, AovKind::CryptoObject).coverage(2, 2, "/late"), 0.f);
    EXPECT_TRUE(read(stage, AovKind::CryptoObject) == read(*fresh(true, "/x"), AovKind::CryptoObject));
    ObjectDesc desc;
    desc.name = "/late";
    desc.asset = "/y";
    desc.geometry = stage.renderer->newId<GeometryId>();
    stage.edit.setGeometry(desc.geometry, quadMesh());
    stage.edit.setObject(late, desc);
    stage.render();
    EXPECT_EQ(read(stage, AovKind::CryptoAsset).coverage(0, 2, "/y"), 1.f);
    EXPECT_EQ(read(stage, AovKind::CryptoMaterial).coverage(0, 2, CryptomatteNoMaterial), 1.f);
}

// Eight things in a pixel: the six ranks are of those that are seen most.
TEST(Cryptomatte, LeavesOutTheLeast) {
    Stage stage(settingsOf(256));
    const float widths[] = {1 / 128.f, 1 / 128.f, 0.25f, 0.25f, 0.125f, 0.125f, 0.125f, 14 / 128.f};
    float x = 0;
    for (int i = 0; i < 8; ++i) {
        addNamed(stage, "/o" + std::to_string(i), "", matte({1, 1, 1}), rect(x, 0, widths[i], 1));
        x += widths[i];
    }
    stage.add(skyLight());
    stage.edit.setCamera(above(1));
    stage.film(1, 1, allLayers());
    stage.render();
    const Mattes objects = read(stage, AovKind::CryptoObject);
    EXPECT_LE(objects.sum(0, 0), 1.f);
    EXPECT_GE(objects.sum(0, 0), 0.97f);
    for (int i = 2; i < 7; ++i)
        EXPECT_NEAR(objects.coverage(0, 0, "/o" + std::to_string(i)), widths[i], 0.02f) << i;
}
