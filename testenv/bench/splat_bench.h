/// @file splat_bench.h
/// Frames of the splat pass: all modes in turns, on captures and on clouds made up.
#pragma once

#include <string>

#include "renderer/higs/splat_pass.h"
#include "testenv/bench/statistics.h"

namespace hipr::bench {

struct SplatBenchOptions {
    std::vector<glm::uvec2> sizes;
    std::vector<SplatMode> modes;
    SplatPassOptions pass;
    int repetitions = 5;
};

/// Of one cloud, size and mode; times in milliseconds.
struct SplatRow {
    std::string cloud;
    glm::uvec2 size{0};
    SplatMode mode = SplatMode::Automatic;
    SplatStatistics statistics; ///< of one more frame, stage by stage
    Spread clock, processor;    ///< of whole frames
};

/// What is drawn again after one instance of two has moved, in the default mode.
struct SplatEditRow {
    std::string cloud;
    glm::uvec2 size{0};
    double drawnShare = 0; ///< of the picture's macro-tiles
    Spread whole, edit;    ///< processor time of a whole frame, and of one after the move, in turns
};

struct SplatReport {
    std::vector<SplatRow> frames;
    std::vector<SplatEditRow> edits;
};

/// A cloud of `count` splats in a room of 4 x 3 x 4 units, with colours of degree 1, that covers most of the
/// picture. The same on every machine.
SplatCloud madeUpCloud(size_t count);

/// Adds the rows of a cloud. Captures are turned by half a turn around x: theirs is a world of y down.
void benchSplats(Device& device, const SplatCloud& cloud, bool capture, const SplatBenchOptions& options,
                 SplatReport& report);

/// As tables of Markdown.
void printSplatTables(std::ostream& out, const SplatReport& report);

} // namespace hipr::bench
