/// @file traversal_bench.h
/// Rays per second of every traversal, against bare Embree on the same rays.
#pragma once

#include <string>
#include <vector>

#include "testenv/bench/statistics.h"

namespace hipr::bench {

struct TraversalRow {
    std::string traversal, rays;
    uint64_t triangles = 0;
    Spread mraysPerSecond, bareMraysPerSecond;
    Spread ratio;           ///< ours / bare, each pair timed back to back
    Spread processorRatio;  ///< the same, per second of processor time
    double disagreeing = 0; ///< share of rays whose answer differs from bare Embree's (edges; ties)
};

struct BuildRow {
    std::string traversal; ///< "bare embree" included
    uint64_t triangles = 0;
    double seconds = 0;
    uint64_t bytes = 0; ///< acceleration structures only; 0: not known
};

struct TraversalReport {
    std::vector<TraversalRow> rows;
    std::vector<BuildRow> builds;
};

/// `triangles`: about how many the room gets. `names`: the traversals to time, none: all. Those that the
/// device cannot run are left out.
TraversalReport benchTraversals(uint32_t triangles, int repetitions, const std::vector<std::string>& names);

} // namespace hipr::bench
