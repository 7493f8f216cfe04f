#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/vulkan/block.h"

namespace hipr {
namespace {

TEST(Block, TakesAllOfItAndNotMore) {
    Block block(1024);
    EXPECT_EQ(block.allocate(1024, 256), 0u);
    EXPECT_FALSE(block.allocate(1, 1));
    EXPECT_EQ(block.freeBytes(), 0u);
    block.free(0, 1024);
    EXPECT_TRUE(block.unused());
    EXPECT_FALSE(block.allocate(1025, 1));
}

TEST(Block, AlignmentGapStaysFree) {
    Block block(1024);
    EXPECT_EQ(block.allocate(10, 1), 0u);
    EXPECT_EQ(block.allocate(10, 256), 256u);
    EXPECT_EQ(block.allocate(246, 1), 10u);
    EXPECT_EQ(block.freeBytes(), 1024u - 266u);
}

TEST(Block, NeighboursMergeInEveryOrder) {
    std::vector<int> order = {0, 1, 2, 3};
    do {
        Block block(400);
        for (int i = 0; i < 4; ++i)
            ASSERT_EQ(block.allocate(100, 1), uint64_t(i) * 100);
        for (const int i : order)
            block.free(uint64_t(i) * 100, 100);
        EXPECT_TRUE(block.unused());
        EXPECT_EQ(block.freeRanges(), 1u);
    } while (std::next_permutation(order.begin(), order.end()));
}

/// Against an array that knows the owner of every byte.
TEST(Block, RandomUseAgreesWithByteMap) {
    constexpr uint64_t Bytes = 4096;
    std::mt19937 random(7);
    Block block(Bytes);
    std::vector<bool> taken(Bytes);
    struct Range {
        uint64_t offset, bytes;
    };
    std::vector<Range> live;
    uint64_t refusals = 0;
    for (int step = 0; step < 20000; ++step) {
        if (live.empty() || random() % 100 < 52) {
            const uint64_t bytes = 1 + random() % 300, alignment = 1ull << (random() % 9);
            const auto fits = [&](uint64_t at) {
                return at + bytes <= Bytes &&
                       std::none_of(taken.begin() + long(at), taken.begin() + long(at + bytes),
                                    [](bool t) { return t; });
            };
            const auto offset = block.allocate(bytes, alignment);
            uint64_t first = 0;
            while (first < Bytes && !fits(first))
                first += alignment;
            if (!offset) {
                EXPECT_GE(first, Bytes) << "refused although it fits";
                ++refusals;
                continue;
            }
            EXPECT_EQ(*offset, first) << "first fit";
            std::fill_n(taken.begin() + long(*offset), bytes, true);
            live.push_back({*offset, bytes});
        } else {
            std::swap(live[random() % live.size()], live.back());
            block.free(live.back().offset, live.back().bytes);
            std::fill_n(taken.begin() + long(live.back().offset), live.back().bytes, false);
            live.pop_back();
        }
        ASSERT_EQ(block.freeBytes(), uint64_t(std::count(taken.begin(), taken.end(), false)));
    }
    EXPECT_GT(refusals, 100u) << "the test has to reach a full block";
    for (const Range& r : live)
        block.free(r.offset, r.bytes);
    EXPECT_TRUE(block.unused());
    EXPECT_EQ(block.freeRanges(), 1u);
}

} // namespace
} // namespace hipr
