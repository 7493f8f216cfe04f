/// @file start_bench.h
/// How long until the first pixel, with and without compiled kernels on disk.
#pragma once

#include <string>

#include "testenv/bench/statistics.h"

namespace hipr::bench {

struct StartReport {
    Spread coldSeconds; ///< no kernel was ever compiled
    Spread warmSeconds; ///< the second start
    double peakMiB = 0; ///< largest resident set of a warm start, kernels and scene included
};

/// Starts `program` anew for every measurement (`<program> first-pixel <triangles>`), in turns: cold, warm,
/// cold, warm.
StartReport benchStart(const std::string& program, uint32_t triangles, int repetitions);

/// What such a child does: makes a renderer, loads the room, renders until the first samples are there, and
/// prints the seconds that took and its peak memory in MiB.
int firstPixel(uint32_t triangles);

} // namespace hipr::bench
