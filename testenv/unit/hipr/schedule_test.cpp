#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "renderer/hipr/schedule.h"
#include "renderer/trace/batch_size.h"

using hipr::TileSchedule;
using hipr::TileState;
using hipr::gpu::TileWork;

namespace {

/// Marks every (pixel, sample) of a batch and checks its slots; returns its paths.
uint32_t mark(const std::vector<TileWork>& work, uint32_t width, std::vector<std::vector<int>>& seen) {
    uint32_t slot = 0;
    for (const TileWork& tile : work) {
        EXPECT_EQ(tile.firstSlot, slot);
        slot += tile.width * tile.height * tile.sampleCount;
        for (uint32_t y = tile.y; y < tile.y + tile.height; ++y)
            for (uint32_t x = tile.x; x < tile.x + tile.width; ++x)
                for (uint32_t s = tile.firstSample; s < tile.firstSample + tile.sampleCount; ++s)
                    ++seen.at(x + y * width).at(s);
    }
    return slot;
}

} // namespace

TEST(TileSchedule, GivesEveryPixelEverySampleOnceInOrder) {
    for (auto [width, height, tile, maxPaths, samples] : {std::tuple{64u, 48u, 16u, 1000u, 5u},
                                                          {7u, 5u, 16u, 4096u, 33u},
                                                          {1u, 1u, 8u, 64u, 100u},
                                                          {100u, 3u, 32u, 2048u, 7u},
                                                          {33u, 65u, 16u, 1u << 20, 12u}}) {
        TileSchedule schedule;
        schedule.reset({width, height, tile});
        std::vector<std::vector<int>> seen(width * height, std::vector<int>(samples));
        std::vector<uint32_t> next(width * height);
        while (true) {
            const std::vector<TileWork>& work = schedule.next(maxPaths, samples);
            if (work.empty()) break;
            std::set<uint32_t> tiles; // none comes twice, for a batch adds its samples in no order
            for (const TileWork& t :
                 work) { // samples of a pixel come in order, or sums would round differently
                EXPECT_TRUE(tiles.insert(t.x + t.y * width).second);
                EXPECT_EQ(next[t.x + t.y * width], t.firstSample);
                next[t.x + t.y * width] += t.sampleCount;
            }
            const uint32_t paths = mark(work, width, seen);
            EXPECT_EQ(paths, schedule.pathCount());
            EXPECT_TRUE(paths <= maxPaths || work.size() == 1);
            schedule.advance();
        }
        EXPECT_EQ(schedule.samplesDone(), samples);
        for (const auto& pixel : seen)
            for (int count : pixel)
                ASSERT_EQ(count, 1);
    }
}

TEST(TileSchedule, FirstPassTakesOneSample) {
    TileSchedule schedule;
    schedule.reset({32, 32, 16});
    for (const TileWork& tile : schedule.next(1 << 16, 64))
        EXPECT_EQ(tile.sampleCount, 1u);
    schedule.advance();
    EXPECT_EQ(schedule.samplesDone(), 1u);
}

TEST(TileSchedule, AbandonedWorkComesAgain) {
    TileSchedule schedule;
    schedule.reset({64, 64, 16});
    const std::vector<TileWork> first = schedule.next(1024, 4);
    const std::vector<TileWork> again = schedule.next(1024, 4);
    ASSERT_EQ(first.size(), again.size());
    for (size_t i = 0; i < first.size(); ++i)
        EXPECT_TRUE(first[i].x == again[i].x && first[i].y == again[i].y);
    schedule.advance();
    EXPECT_NE(schedule.next(1024, 4)[0].y * 64 + schedule.next(1024, 4)[0].x, 0u);
}

TEST(TileSchedule, NothingToDo) {
    TileSchedule schedule;
    EXPECT_TRUE(schedule.next(1024, 4).empty());
    schedule.reset({0, 100, 16});
    EXPECT_TRUE(schedule.next(1024, 4).empty());
    schedule.reset({4, 4, 16});
    EXPECT_TRUE(schedule.next(1024, 0).empty());
}

TEST(BatchSize, FollowsTheClock) {
    hipr::BatchSize batch(1 << 16);
    const uint32_t first = batch.paths();
    batch.report(first, 0.001);
    EXPECT_EQ(batch.paths(), 2 * first);
    for (int i = 0; i < 20; ++i)
        batch.report(batch.paths(), 0.001);
    EXPECT_EQ(batch.paths(), 1u << 16);
    for (int i = 0; i < 20; ++i)
        batch.report(batch.paths(), 1.0);
    EXPECT_EQ(batch.paths(), hipr::BatchSize::Smallest);
    batch.report(10, 0.001); // a small rest says nothing about full batches
    EXPECT_EQ(batch.paths(), hipr::BatchSize::Smallest);
}

TEST(BatchSize, IsLargerWhereNobodyWatches) {
    hipr::BatchSize batch(1 << 20);
    batch.setPatience(10.0);
    for (int i = 0; i < 20; ++i)
        batch.report(batch.paths(), 1e-5 * batch.paths());
    EXPECT_GT(1e-5 * batch.paths(), 3 * hipr::BatchSize::Long);
    EXPECT_LE(1e-5 * batch.paths(), 10 * hipr::BatchSize::Long);
}

TEST(BatchSize, FindsItsSizeForAnySpeedAndKeepsIt) {
    for (double perPath = 1e-7; perPath < 1e-5; perPath *= 1.1) {
        hipr::BatchSize batch(1 << 16);
        for (int i = 0; i < 10; ++i)
            batch.report(batch.paths(), perPath * batch.paths());
        const uint32_t found = batch.paths();
        for (double slower : {1.2, 1.6, 1.0, 1.4}) {
            batch.report(batch.paths(), slower * perPath * batch.paths());
            EXPECT_EQ(batch.paths(), found) << perPath << " s a path";
        }
    }
}

namespace {

/// Renders the next batch; `change` tells what the first samples of a tile change. Their noise is 1.
template <class Change>
uint32_t step(TileSchedule& schedule, uint32_t maxPaths, uint32_t samples, Change&& change) {
    const std::vector<TileWork>& work = schedule.next(maxPaths, samples);
    for (const TileWork& tile : work)
        if (tile.firstSample == 0)
            schedule.measured(schedule.grid().at(tile.x, tile.y), change(schedule.grid().at(tile.x, tile.y)),
                              1.f);
    const uint32_t paths = schedule.pathCount();
    schedule.advance();
    return paths;
}

/// A picture of 64 x 64 pixels with all its samples, and then an edit.
TileSchedule edited(uint32_t samples, uint32_t tileSize = 16) {
    TileSchedule schedule;
    schedule.reset({64, 64, tileSize});
    while (!schedule.next(4096, samples).empty())
        schedule.advance();
    schedule.invalidate();
    return schedule;
}

} // namespace

TEST(TileSchedule, DiscoveredTilesComeFirstInTheirOrder) {
    TileSchedule schedule = edited(4);
    schedule.setFloor(0.f);
    schedule.discover(5, 1.f);
    schedule.discover(9, 3.f);
    schedule.discover(2, 2.f);
    schedule.sort(false);
    const std::vector<TileWork> work = schedule.next(3 * 256, 4);
    ASSERT_EQ(work.size(), 3u);
    EXPECT_EQ(schedule.grid().at(work[0].x, work[0].y), 9u);
    EXPECT_EQ(schedule.grid().at(work[1].x, work[1].y), 2u);
    EXPECT_EQ(schedule.grid().at(work[2].x, work[2].y), 5u);
}

TEST(TileSchedule, TellsWhetherATileHadBeenDiscoveredWhenItsTurnCame) {
    TileSchedule schedule = edited(4);
    schedule.setFloor(0.f);
    schedule.discover(5, 1.f);
    schedule.sort(false);
    step(schedule, 256, 4, [](uint32_t) { return 0.f; });
    EXPECT_TRUE(schedule.tiles()[5].foreseen) << "though nothing changed in it";
    step(schedule, 256, 4, [](uint32_t) { return 1.f; });
    EXPECT_EQ(schedule.tiles()[0].samples, 1u);
    EXPECT_FALSE(schedule.tiles()[0].foreseen) << "its own sample told";
    EXPECT_GT(schedule.tiles()[0].priority, 0.f);
}

TEST(TileSchedule, EveryTileIsLookedAtBeforeAnyGetsMore) {
    TileSchedule schedule = edited(8);
    schedule.discover(5, 1.f);
    schedule.sort(false);
    uint64_t paths = 0;
    while (schedule.samplesDone() == 0) {
        paths += step(schedule, 512, 8, [](uint32_t tile) { return tile == 5 || tile == 6 ? 1.f : 0.f; });
        ASSERT_LE(paths, 64u * 64);
    }
    EXPECT_EQ(paths, 64u * 64);
    EXPECT_EQ(schedule.discoveredTiles(), 2u);
    while (schedule.tiles()[0].samples < 2) // then those that changed get all, before the others
        step(schedule, 512, 8, [](uint32_t) { return 0.f; });
    EXPECT_EQ(schedule.tiles()[5].samples, 8u);
    EXPECT_EQ(schedule.tiles()[6].samples, 8u);
}

TEST(TileSchedule, UnchangedTilesKeepTheirPictureUntilTheNewOneIsAsGood) {
    TileSchedule schedule = edited(8);
    schedule.discover(5, 1.f);
    schedule.sort(false);
    std::vector<uint32_t> saved;
    while (schedule.samplesDone() == 0) {
        for (const TileWork& tile : schedule.next(512, 8))
            if (tile.flags & hipr::gpu::TILE_SAVES_OLD) saved.push_back(schedule.grid().at(tile.x, tile.y));
        step(schedule, 512, 8, [](uint32_t tile) { return tile == 5 ? 1.f : 0.f; });
    }
    EXPECT_EQ(saved.size(), 16u);
    EXPECT_FALSE(schedule.tiles()[5].keepsOld);
    EXPECT_EQ(schedule.tiles()[5].age, 0u);
    EXPECT_TRUE(schedule.tiles()[0].keepsOld);
    EXPECT_EQ(schedule.tiles()[0].age, 1u);
    while (schedule.tiles()[0].samples < 8) {
        EXPECT_TRUE(schedule.tiles()[0].keepsOld);
        step(schedule, 512, 8, [](uint32_t) { return 0.f; });
    }
    EXPECT_FALSE(schedule.tiles()[0].keepsOld);
    EXPECT_EQ(schedule.tiles()[0].age, 0u);
}

TEST(TileSchedule, ASmallChangeWaitsUntilItShowsThroughTheNoise) {
    // 16 samples on display, the change times 4 is 0.4: noise 1 / sqrt(n) is below it, and the old picture's
    // own noise, when 1 / n <= 0.16 + 1 / 16.
    TileSchedule schedule = edited(16);
    while (schedule.samplesDone() < 16) {
        step(schedule, 256, 16, [](uint32_t tile) { return tile == 5 ? 0.1f : tile == 6 ? 0.3f : 0.f; });
        const TileState &small = schedule.tiles()[5], &plain = schedule.tiles()[6],
                        &none = schedule.tiles()[7];
        EXPECT_EQ(small.keepsOld, small.samples > 0 && small.samples < 5) << small.samples;
        EXPECT_FALSE(plain.keepsOld);
        EXPECT_EQ(none.keepsOld, none.samples > 0 && none.samples < 16) << none.samples;
    }
}

TEST(TileSchedule, SmallChangesAddUpFromEditToEdit) {
    TileSchedule schedule = edited(16);
    const auto little = [](uint32_t) { return 0.1f; };
    for (int edit = 0; edit < 3; ++edit) {
        if (edit) schedule.invalidate();
        const std::vector<TileWork> work = schedule.next(256, 16);
        ASSERT_EQ(work.size(), 1u);
        EXPECT_EQ(work[0].flags, edit ? hipr::gpu::TILE_KEEPS_OLD : hipr::gpu::TILE_SAVES_OLD);
        step(schedule, 256, 16, little);
        const uint32_t tile = schedule.grid().at(work[0].x, work[0].y);
        EXPECT_EQ(tile, 0u) << "the oldest picture";
        EXPECT_EQ(schedule.tiles()[tile].keepsOld, edit < 2) << "1 > (4 * 0.1 * edits)^2 + 1 / 16";
    }
}

TEST(TileSchedule, WithoutAMeasureNoOldPictureIsKept) {
    TileSchedule schedule = edited(16);
    step(schedule, 256, 16, [](uint32_t) { return 0.f; });
    EXPECT_TRUE(schedule.tiles()[0].keepsOld);
    schedule.invalidate(); // the camera moves, say
    schedule.next(4096, 16);
    schedule.advance();
    EXPECT_FALSE(schedule.tiles()[0].keepsOld);
    EXPECT_EQ(schedule.tiles()[0].age, 0u);
}

TEST(TileSchedule, AnAlmostEmptyBatchIsNotForTheFloor) {
    TileSchedule schedule = edited(8);
    schedule.discover(5, 1.f);
    schedule.sort(false);
    const std::vector<TileWork>& work = schedule.next(1 << 16, 8);
    ASSERT_EQ(work.size(), 1u);
    EXPECT_EQ(schedule.grid().at(work[0].x, work[0].y), 5u);
}

TEST(TileSchedule, ABatchIsFilledUpWithOthersWhenFewDiscoveredTilesAreLeft) {
    constexpr uint32_t Pixels = 64; // of a tile; a sixteenth of the picture are four tiles
    TileSchedule schedule = edited(8, 8);
    schedule.setFloor(0.f);
    const auto changing = [](uint32_t tile) { return tile == 5 || tile == 6 || tile == 9 ? 1.f : 0.f; };
    for (uint32_t tile : {5u, 6u, 9u})
        schedule.discover(tile, 1.f);
    schedule.sort(false);
    EXPECT_EQ(step(schedule, 2 * Pixels, 8, changing), 2 * Pixels) << "two of the three";
    const std::vector<TileWork>& work = schedule.next(20 * Pixels, 8);
    ASSERT_EQ(work.size(), 4u);
    EXPECT_EQ(schedule.grid().at(work[0].x, work[0].y), 9u);
    for (uint32_t i = 0; i < 3; ++i)
        EXPECT_EQ(schedule.grid().at(work[1 + i].x, work[1 + i].y), i);
    step(schedule, 20 * Pixels, 8, changing);
    EXPECT_EQ(schedule.next(20 * Pixels, 8).size(), 20u) << "nothing discovered waits";
}

TEST(TileSchedule, LaterPassesAreOneStreamOfFullBatches) {
    TileSchedule schedule = edited(5);
    for (uint32_t tile : {5u, 6u, 9u})
        schedule.discover(tile, 1.f);
    schedule.sort(false);
    while (schedule.samplesDone() == 0)
        step(schedule, 7 * 256, 5,
             [](uint32_t tile) { return tile == 5 || tile == 6 || tile == 9 ? 1.f : 0.f; });
    uint32_t small = 0;
    while (schedule.samplesDone() < 5)
        small += step(schedule, 7 * 256, 5, [](uint32_t) { return 0.f; }) < 6 * 256;
    EXPECT_LE(small, 1u) << "but for the last";
}

// In a stream of edits that all show in the same tiles the others get their share.
TEST(TileSchedule, NothingStarvesInAStreamOfEdits) {
    TileSchedule changing = edited(4);
    uint32_t oldest = 0;
    for (int edit = 0; edit < 200; ++edit) {
        changing.invalidate();
        for (uint32_t tile = 0; tile < 8; ++tile)
            changing.discover(tile, 1.f);
        changing.sort(false);
        step(changing, 1024, 4, [](uint32_t) { return 1.f; });
        for (uint32_t tile = 8; tile < 16; ++tile)
            oldest = std::max(oldest, changing.tiles()[tile].age);
    }
    EXPECT_LT(oldest, 40u);
}

// With a pilot every tile gets the pilot's samples and then, pilot apart, those it wants; what replaces the
// pilot on display is as good as the pilot was. No sample comes twice, and what is complete takes no more
// work.
TEST(TileSchedule, TilesStopWhereTheyWantTo) {
    constexpr uint32_t Pilot = 4, Most = 1000;
    for (uint32_t greatest : {5000u, 40u}) {
        TileSchedule schedule;
        schedule.setPilot(Pilot);
        schedule.reset({64, 48, 16});
        std::vector<uint32_t> next(12);
        uint32_t batches = 0;
        for (;; ++batches) {
            const std::vector<TileWork> work = schedule.next(4096, Most);
            if (work.empty()) break;
            for (const TileWork& w : work) {
                const uint32_t tile = schedule.grid().at(w.x, w.y), end = w.firstSample + w.sampleCount;
                EXPECT_EQ(next[tile], w.firstSample);
                next[tile] = end;
                EXPECT_TRUE(end <= Pilot || w.firstSample >= Pilot)
                    << "a batch is either of the pilot or not";
                if (w.firstSample == Pilot) {
                    EXPECT_GE(w.sampleCount, Pilot);
                }
                if (end == Pilot) schedule.want(tile, tile == 7 ? greatest : tile);
            }
            schedule.advance();
            const uint64_t paths = schedule.pathsDone();
            EXPECT_LE(paths, schedule.pathsWanted(Most));
        }
        for (uint32_t tile = 0; tile < 12; ++tile) {
            EXPECT_EQ(next[tile], Pilot + std::min(tile == 7 ? greatest : std::max(tile, Pilot), Most))
                << tile;
            EXPECT_EQ(schedule.samplesInMean(tile), next[tile] - Pilot);
        }
        EXPECT_EQ(schedule.samplesDone(), Most);
        EXPECT_EQ(schedule.pathsDone(), schedule.pathsWanted(Most));
        EXPECT_LT(batches, 200u) << "the last tile's samples come many at a time";
    }
}
