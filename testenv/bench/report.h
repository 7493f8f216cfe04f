/// @file report.h
/// The results as a table for people and as JSON for machines.
#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include "testenv/bench/frame_bench.h"
#include "testenv/bench/start_bench.h"
#include "testenv/bench/traversal_bench.h"

namespace hipr::bench {

struct Report {
    std::string device, driver;
    unsigned threads = 0;
    double loadBefore = 0; ///< 1-minute load average when the run began: above 0.5 something else was running
    int repetitions = 0;
    std::vector<TraversalReport> traversals;
    std::vector<FrameRow> frames;
    std::optional<StartReport> start;
};

void printTables(std::ostream& out, const Report& report);
nlohmann::json toJson(const Report& report);

} // namespace hipr::bench
