/// @file statistics.h
/// Repeated timings and what is reported of them.
#pragma once

#include <chrono>
#include <vector>

#include <nlohmann/json.hpp>

namespace hipr::bench {

/// Median, smallest and largest of repeated measurements.
struct Spread {
    double median = 0, minimum = 0, maximum = 0;
};
Spread spread(std::vector<double> values);
nlohmann::json toJson(const Spread& spread);

/// Wall-clock seconds `work` takes.
template <class Work> double seconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace hipr::bench
