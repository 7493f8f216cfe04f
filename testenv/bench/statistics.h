/// @file statistics.h
/// Repeated timings and what is reported of them.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace hipr::bench {

/// Median, smallest and largest of repeated measurements.
struct Spread {
    double median = 0, minimum = 0, maximum = 0;
};
Spread spread(std::vector<double> values);
nlohmann::json toJson(const Spread& spread);

/// For tables: with so many digits behind the point; a spread as median (least-most).
std::string text(double value, int digits);
std::string text(const Spread& spread, int digits);
constexpr double MiB = 1 << 20;

/// Seconds on the clock, and of all threads of this process together. The latter hold on a busy machine, too.
struct Timing {
    double clock = 0, processor = 0;
};
double processorSeconds();

template <class Work> Timing timed(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    const double processor = processorSeconds();
    work();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            processorSeconds() - processor};
}

} // namespace hipr::bench
