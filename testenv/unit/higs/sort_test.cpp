// Lists of every length, sorted by the kernels and by the C++ library.
#include <algorithm>
#include <cstring>

#include "renderer/higs/splat_stages.h"
#include "testenv/unit/higs/scenes.h"
#include "testenv/unit/sampling/gpu.h"

namespace hipr::test {
namespace {

class SplatLists : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(, SplatLists, ::testing::Bool(),
                         [](const auto& info) { return info.param ? "Lanes" : "Workgroups"; });

/// Stages on a row of macro-tiles whose lists have these lengths, with room for all.
std::unique_ptr<SplatStages> stagesWith(const std::vector<uint32_t>& lengths, bool lanes) {
    auto stages = std::make_unique<SplatStages>(testDevice(), lanes, false);
    gpu::SplatFrame frame{};
    frame.width = uint32_t(lengths.size()) * gpu::SPLAT_MACRO_WIDTH;
    frame.height = gpu::SPLAT_MACRO_HEIGHT;
    frame.tileWidth = gpu::SPLAT_MACRO_WIDTH;
    frame.tileHeight = gpu::SPLAT_MACRO_HEIGHT;
    frame.tileColumns = uint32_t(lengths.size());
    frame.tileRows = 1;
    stages->setUp(SplatMode::Higs8Carry, frame, {}, {}, {});
    // What `count` would leave: in lanes the last chunk's counters hold all.
    std::vector<uint32_t> counters(stages->buffers().histogram.buffer().bytes() / sizeof(uint32_t), 0);
    const auto scan = [&] {
        std::fill(counters.begin(), counters.end(), 0);
        const size_t first = lanes ? (gpu::SPLAT_CHUNKS - 1) * lengths.size() : 0;
        std::copy(lengths.begin(), lengths.end(), counters.begin() + long(first));
        testDevice().upload(stages->buffers().histogram.buffer(), counters.data(),
                            counters.size() * sizeof(uint32_t));
        testDevice().run([&](VkCommandBuffer cmd) {
            stages->clear(cmd, true);
            computeBarrier(cmd);
            stages->scan(cmd);
        });
    };
    scan();
    if (stages->state().overflow) {
        stages->makeRoom(stages->state());
        scan();
    }
    EXPECT_EQ(stages->state().overflow, 0u);
    return stages;
}

void expectSorted(const std::vector<uint32_t>& lengths, bool lanes, uint32_t differentKeys) {
    const auto stages = stagesWith(lengths, lanes);
    const auto tiles = toHost<gpu::SplatTile>(stages->buffers().tiles.buffer(), lengths.size());
    const gpu::SplatState state = stages->state();
    std::vector<gpu::SplatPair> pairs(state.pairsEnd);
    Numbers random(differentKeys);
    uint32_t total = 0, batches = 0;
    for (size_t t = 0; t < lengths.size(); ++t) {
        ASSERT_EQ(tiles[t].count, lengths[t]);
        ASSERT_EQ(tiles[t].first % gpu::SPLAT_MINI_BATCH, 0u);
        ASSERT_EQ(tiles[t].firstBatch, batches);
        batches += (lengths[t] + gpu::SPLAT_BATCH - 1) / gpu::SPLAT_BATCH;
        for (uint32_t i = 0; i < lengths[t]; ++i) {
            const float key =
                differentKeys ? float(uint32_t(random(0, float(differentKeys)))) * 0.37f : random(0.f, 1e30f);
            uint32_t bits;
            std::memcpy(&bits, &key, 4);
            pairs[tiles[t].first + i] = {total++, bits};
        }
    }
    EXPECT_EQ(state.pairs, total);
    EXPECT_EQ(state.batches, batches);
    EXPECT_EQ(state.largestList, *std::max_element(lengths.begin(), lengths.end()));
    testDevice().upload(stages->buffers().pairs[0].buffer(), pairs.data(), pairs.size() * sizeof(pairs[0]));
    testDevice().run([&](VkCommandBuffer cmd) { stages->sort(cmd); });

    for (size_t t = 0; t < lengths.size(); ++t) {
        const auto first = pairs.begin() + tiles[t].first;
        std::stable_sort(first, first + lengths[t],
                         [](const auto& a, const auto& b) { return a.key < b.key; });
        std::vector<gpu::SplatPair> sorted(lengths[t]);
        testDevice().download(stages->buffers().pairs[tiles[t].side].buffer(), sorted.data(),
                              lengths[t] * sizeof(sorted[0]), tiles[t].first * sizeof(sorted[0]));
        for (uint32_t i = 0; i < lengths[t]; ++i) {
            ASSERT_EQ(sorted[i].key, first[i].key) << "list " << t << " of " << lengths[t] << ", place " << i;
            ASSERT_EQ(sorted[i].splat, first[i].splat) << "list " << t << " of " << lengths[t];
        }
    }
}

const std::vector<uint32_t> Lengths = {0,    1,    0,     2,    3,    31,   32,   33,    0,    100,  1023,
                                       1024, 1025, 2047,  2048, 2049, 3000, 4097, 8191,  8192, 8193, 1,
                                       0,    7,    20000, 5,    600,  1500, 9,    40000, 0,    0};

TEST_P(SplatLists, SortedLikeTheLibraryDoes) {
    expectSorted(Lengths, GetParam(), 0);
}

TEST_P(SplatLists, TiesInOrderOfSplats) {
    expectSorted(Lengths, GetParam(), 50);
    expectSorted(Lengths, GetParam(), 1);
}

TEST_P(SplatLists, ManyTiles) {
    std::vector<uint32_t> lengths;
    Numbers random(3);
    for (int i = 0; i < 5000; ++i)
        lengths.push_back(uint32_t(random(0, 12)));
    expectSorted(lengths, GetParam(), 0);
}

TEST_P(SplatLists, EmptyOnly) {
    const auto stages = stagesWith({0, 0, 0}, GetParam());
    testDevice().run([&](VkCommandBuffer cmd) { stages->sort(cmd); });
    EXPECT_EQ(stages->state().batches, 0u);
}

} // namespace
} // namespace hipr::test
