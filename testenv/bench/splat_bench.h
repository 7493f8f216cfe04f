/// @file splat_bench.h
/// Times the splat pass: every mode in turns, and a prim that moves.
#pragma once

#include <optional>

#include "renderer/vulkan/device.h"
#include "testenv/bench/splat_scenes.h"
#include "testenv/bench/statistics.h"

namespace hipr::bench {

struct SplatBenchOptions {
    std::vector<SplatMode> modes;
    std::vector<glm::uvec2> sizes;
    SplatPassOptions pass;
    int repetitions = 5;
    double budget = 6;      ///< seconds for a scene and size: once spent, no further turn begins; 0: no limit
    bool countOnly = false; ///< one frame each, and no times
    bool move = false;      ///< also measure a prim that moves
    std::string pictures;   ///< folder for a .ppm of every frame; empty: none
};

/// A mode at a size.
struct SplatRow {
    std::string mode;
    glm::uvec2 size{0};
    Spread frameMs, processorMs; ///< one frame of a moving camera, all stages
    SplatStatistics statistics;  ///< of one more frame, while profiling
};

/// A frame after a prim moved that covers part of the picture, against a whole frame of the same scene.
struct SplatMoveRow {
    std::string mode;
    glm::uvec2 size{0};
    double covered = 0; ///< share of the picture's macro-tiles in which the prim is
    double drawn = 0;   ///< share that is drawn again
    Spread wholeMs, movedMs, wholeProcessorMs, movedProcessorMs;
};

struct SplatReport {
    std::string scene;
    size_t splats = 0;
    uint32_t degree = 0;
    double loadSeconds = 0, storeSeconds = 0;
    uint64_t storeBytes = 0, deviceBytes = 0; ///< the latter with all buffers of all modes at all sizes
    double peakMiB = 0;                       ///< resident set of the process so far
    std::vector<SplatRow> rows;
    std::optional<SplatMoveRow> moved;
};

SplatReport benchSplats(Device& device, const SplatScene& scene, const SplatBenchOptions& options);

void printSplats(std::ostream& out, const SplatReport& report);
nlohmann::json toJson(const SplatReport& report);

} // namespace hipr::bench
