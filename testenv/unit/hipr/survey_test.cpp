// Scouts find where pictures differ.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "renderer/hipr/footprint.h"
#include "renderer/hipr/survey.h"

using namespace hipr;

namespace {

/// Runs a survey of a picture that changed by `change(x, y)`.
std::vector<float> run(Survey& survey, const std::function<float(uint32_t, uint32_t)>& change,
                       uint32_t maxPaths = 4096) {
    while (true) {
        const std::vector<gpu::TileWork> work = survey.next(maxPaths);
        if (work.empty()) break;
        std::vector<gpu::ScoutResult> results;
        for (const gpu::TileWork& w : work) {
            EXPECT_EQ(w.firstSlot, results.size());
            for (uint32_t i = 0; i < w.width * w.height; ++i) {
                const uint32_t x = w.x + w.stride * (i % w.width), y = w.y + w.stride * (i / w.width);
                const float c = change(x, y);
                results.push_back({x | y << 16, c, 1.f});
            }
        }
        EXPECT_EQ(results.size(), survey.pathCount());
        survey.report(results);
    }
    return survey.priorities();
}

} // namespace

TEST(Survey, LooksAtTheWholePictureAtItsRate) {
    const TileGrid grid(320, 200, 16);
    Survey survey;
    survey.begin(grid, 1.f / 64, 1);
    std::set<uint32_t> tiles;
    std::vector<float> priorities = run(survey, [&](uint32_t x, uint32_t y) {
        EXPECT_LT(x, 320u);
        EXPECT_LT(y, 200u);
        tiles.insert(grid.at(x, y));
        return 0.f;
    });
    EXPECT_EQ(tiles.size(), grid.count());
    EXPECT_EQ(survey.pathsTraced(), 320u * 200 / 64);
    for (float p : priorities)
        EXPECT_EQ(p, 0.f);
}

TEST(Survey, BatchSizeDoesNotMatter) {
    const TileGrid grid(100, 70, 16);
    const auto change = [](uint32_t x, uint32_t y) { return x > 40 && x < 60 && y < 30 ? float(y) : 0.f; };
    std::vector<float> expected;
    for (uint32_t maxPaths : {1u, 13u, 200u, 1u << 16}) {
        Survey survey;
        survey.begin(grid, 1.f / 64, 5);
        const std::vector<float> found = run(survey, change, maxPaths);
        if (expected.empty()) expected = found;
        EXPECT_EQ(found, expected) << maxPaths;
    }
}

TEST(Survey, RanksTilesByTheirChange) {
    const TileGrid grid(320, 320, 16);
    Survey survey;
    survey.begin(grid, 1.f / 64, 2);
    const std::vector<float> priorities = run(survey, [](uint32_t x, uint32_t y) {
        return x < 64 && y < 64 ? 1.f : x >= 256 && y >= 256 ? 0.25f : 0.f;
    });
    EXPECT_GT(priorities[grid.at(20, 20)], 2 * priorities[grid.at(300, 300)]);
    EXPECT_GT(priorities[grid.at(300, 300)], 0.f);
    EXPECT_EQ(priorities[grid.at(160, 160)], 0.f);
}

TEST(Survey, SuspectsGetMoreScouts) {
    const TileGrid grid(256, 256, 16);
    const auto count = [&](bool suspect) {
        Survey survey;
        survey.begin(grid, 1.f / 64, 4);
        if (suspect) survey.suspect(17);
        uint32_t scouts = 0;
        run(survey, [&](uint32_t x, uint32_t y) {
            scouts += grid.at(x, y) == 17;
            return 0.f;
        });
        return scouts;
    };
    EXPECT_EQ(count(false), 4u);
    EXPECT_EQ(count(true), 8u);
}

TEST(Survey, SpreadsOnlyIfAsked) {
    const TileGrid grid(256, 256, 16);
    const auto scoutsNextToAChange = [&](bool spread) {
        Survey survey;
        survey.begin(grid, 1.f / 64, 4, spread);
        uint32_t scouts = 0;
        run(survey, [&](uint32_t x, uint32_t y) {
            scouts += grid.at(x, y) == 18;
            return grid.at(x, y) == 17 ? 1.f : 0.f;
        });
        return scouts;
    };
    EXPECT_EQ(scoutsNextToAChange(false), 4u);
    EXPECT_EQ(scoutsNextToAChange(true), 16u);
}

TEST(Survey, KnowsItsFirstRound) {
    const TileGrid grid(256, 256, 16);
    Survey survey;
    survey.begin(grid, 1.f / 64, 4);
    EXPECT_EQ(survey.pixelsPerScout(), 64.f);
    survey.suspect(17);
    uint64_t first = 0;
    while (true) {
        const bool inFirst = survey.firstRound();
        const std::vector<gpu::TileWork> work = survey.next(100);
        if (work.empty()) break;
        std::vector<gpu::ScoutResult> results(survey.pathCount(), gpu::ScoutResult{0, 0.f, 1.f});
        first += inFirst ? results.size() : 0;
        survey.report(results);
    }
    EXPECT_EQ(first, 256u * 256 / 64);
    EXPECT_GT(survey.pathsTraced(), first);
}

TEST(Survey, EditsInARowLookAtDifferentPixels) {
    const TileGrid grid(64, 64, 16);
    std::set<uint32_t> pixels;
    for (uint32_t turn = 0; turn < 64; ++turn) {
        Survey survey;
        survey.begin(grid, 1.f / 64, turn);
        run(survey, [&](uint32_t x, uint32_t y) {
            pixels.insert(x % 8 + y % 8 * 8);
            return 0.f;
        });
    }
    EXPECT_GT(pixels.size(), 36u); // of 64; 64 random draws would find 41 on average
}

TEST(Footprint, IsWhereTheCameraSeesTheBox) {
    gpu::CameraRecord camera{};
    camera.worldToClip = glm::mat4(1.f); // sees [-1, 1]^2
    const TileGrid grid(160, 160, 16);
    const auto tiles = [&](glm::vec3 lo, glm::vec3 hi) {
        std::set<uint32_t> seen;
        forTilesSeeing(grid, camera, {lo, hi}, [&](uint32_t tile) { seen.insert(tile); });
        return seen;
    };
    EXPECT_EQ(tiles({-0.55f, -0.55f, 0}, {-0.45f, -0.45f, 0}), (std::set<uint32_t>{22}));
    EXPECT_EQ(tiles({-3, -3, 0}, {3, 3, 0}).size(), 100u);
    EXPECT_TRUE(tiles({1.2f, 0, 0}, {2, 1, 0}).empty());
    EXPECT_TRUE(tiles({1, 0, 0}, {-1, 1, 0}).empty());
    camera.worldToClip[3][3] = -1.f; // behind
    EXPECT_EQ(tiles({0, 0, 0}, {0.1f, 0.1f, 0}).size(), 100u);
}
