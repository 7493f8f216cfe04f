// The limit of the memory that textures take.
#include <gtest/gtest.h>

#include "renderer/shading/texture_limit.h"
#include "testenv/unit/sampling/gpu.h"
#include "testenv/unit/shading/picture.h"

namespace hipr::test {
namespace {

TextureSource sourceOf(std::vector<LevelSize> tiles, bool ofLight = false) {
    TextureSource source;
    source.ofLight = ofLight;
    for (const LevelSize& size : tiles) {
        TextureTile& tile = source.tiles.emplace_back();
        if (size.width) tile.header.levels = {size};
        tile.format = gpu::TEXEL_RGBA8;
    }
    return source;
}

TEST(TextureLimit, TheLargestGiveTheirFinestLevels) {
    TextureSource large = sourceOf({{64, 64}, {0, 0}, {32, 32}}), small = sourceOf({{32, 32}});
    const uint64_t of64 = levelBytes(levelSizes({64, 64}), 4), of32 = levelBytes(levelSizes({32, 32}), 4);
    const auto fit = [&](uint64_t limit) { return fitTextures({&large, &small}, limit); };
    const auto finest = [&] {
        return std::vector<uint32_t>{large.tiles[0].finest, large.tiles[2].finest, small.tiles[0].finest};
    };
    const TextureFit all = fit(of64 + 2 * of32);
    EXPECT_EQ(all.wanted, of64 + 2 * of32);
    EXPECT_EQ(all.taken, all.wanted);
    EXPECT_EQ(all.reduced, 0u);
    EXPECT_EQ(all.pictures, 3u);
    EXPECT_EQ(finest(), (std::vector<uint32_t>{0, 0, 0}));
    EXPECT_EQ(fit(all.wanted - 1).taken, 3 * of32);
    EXPECT_EQ(finest(), (std::vector<uint32_t>{1, 0, 0}));
    const TextureFit two = fit(3 * of32 - 1); // the first of three that are as large
    EXPECT_EQ(finest(), (std::vector<uint32_t>{2, 0, 0}));
    EXPECT_EQ(two.reduced, 1u);
    EXPECT_EQ(fit(0).taken, 3u * 4u); // a texel each
    EXPECT_EQ(finest(), (std::vector<uint32_t>{6, 5, 5}));
    EXPECT_EQ(fit(all.wanted).taken, all.wanted);
    EXPECT_EQ(finest(), (std::vector<uint32_t>{0, 0, 0}));
}

TEST(TextureLimit, LightsKeepTheirs) {
    TextureSource light = sourceOf({{64, 64}}, true), other = sourceOf({{8, 8}});
    const TextureFit fit = fitTextures({&light, &other}, 64 * 64 * 4 + 4 + 16);
    EXPECT_EQ(light.tiles[0].finest, 0u);
    EXPECT_EQ(other.tiles[0].finest, 2u);
    EXPECT_EQ(fit.taken, 64u * 64u * 4u + 4u + 16u);
}

uint64_t textureBytes() {
    for (const MemoryReport::Row& row : testDevice().memory().rows)
        if (row.kind == "textures") return row.bytes;
    return 0;
}

struct LimitedStore {
    Files files = {{"a.exr", encodeLevels(64, 64, {1, 2, 3, 4, 5, 6, 7})},
                   {"b.exr", encodeLevels(64, 64, {1, 2, 3, 4, 5, 6, 7})},
                   {"c.png", encode8("png", 64, 64, 3, std::vector<uint8_t>(64 * 64 * 3, 200))}};
    TextureStore store{testDevice(), serve(files), ColorManager::create({})};
    uint32_t add(const std::string& path) {
        return store.acquire({path, "auto", WrapMode::Clamp, WrapMode::Clamp, false}, "/m");
    }
};

TEST(TextureLimit, IsHonouredAndToldOnce) {
    messageLog().entries.clear();
    const uint64_t before = textureBytes(), half = levelBytes(levelSizes({64, 64}), gpu::TEXEL_RGBA16F);
    LimitedStore kit;
    kit.store.setLimit(2 * half);
    kit.add("a.exr");
    const uint32_t b = kit.add("b.exr");
    EXPECT_TRUE(kit.store.commit());
    EXPECT_EQ(messageLog().entries.size(), 0u);
    EXPECT_LE(textureBytes() - before, 2 * half + 4096); // of which the table
    const uint32_t c = kit.add("c.png");
    EXPECT_TRUE(kit.store.commit());
    EXPECT_LE(textureBytes() - before, 2 * half + 4096);
    ASSERT_EQ(messageLog().entries.size(), 1u);
    EXPECT_NE(messageLog().entries[0].text.find("1 of 3 pictures"), std::string::npos)
        << messageLog().entries[0].text;
    kit.store.release(c);
    EXPECT_TRUE(kit.store.commit());
    EXPECT_EQ(messageLog().entries.size(), 1u);
    kit.store.setLimit(half);
    EXPECT_TRUE(kit.store.commit());
    EXPECT_EQ(messageLog().entries.size(), 2u);
    EXPECT_FALSE(kit.store.commit());
    kit.store.setLimit(half);
    EXPECT_FALSE(kit.store.commit());
    kit.store.release(b);
    kit.store.commit();
    messageLog().entries.clear();
}

TEST(TextureLimit, HistoryDoesNotShow) {
    const uint64_t of64 = levelBytes(levelSizes({64, 64}), gpu::TEXEL_RGBA16F), limit = of64 * 3 / 2;
    const uint64_t before = textureBytes();
    const auto taken = [&] { return textureBytes() - before; };
    uint64_t ofAll = 0, ofTwo = 0;
    {
        LimitedStore fresh;
        fresh.store.setLimit(limit);
        fresh.add("b.exr");
        fresh.add("c.png");
        fresh.store.commit();
        ofTwo = taken();
        fresh.add("a.exr");
        fresh.store.commit();
        ofAll = taken();
        EXPECT_LT(ofAll, limit);
    }
    LimitedStore edited;
    const uint32_t c = edited.add("c.png"), a = edited.add("a.exr");
    edited.store.commit();
    edited.store.setLimit(limit);
    edited.add("b.exr");
    edited.store.commit();
    EXPECT_EQ(taken(), ofAll);
    edited.store.release(a);
    edited.store.commit();
    EXPECT_EQ(taken(), ofTwo);
    edited.store.release(c);
    edited.store.commit();
    EXPECT_NEAR(double(taken()), double(of64), 4096);
    messageLog().entries.clear();
}

} // namespace
} // namespace hipr::test
