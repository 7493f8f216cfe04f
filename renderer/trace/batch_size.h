/// @file batch_size.h
/// How many paths a batch should have.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hipr {

/// Steers batches towards a duration at which a host stays responsive: doubles when they are short, halves
/// when they are long, which one that was short and doubled is not. Starts small, so that the first picture
/// comes soon.
class BatchSize {
public:
    static constexpr uint32_t Smallest = 8192, First = 8192;
    static constexpr double Short = 0.030, Long = 0.100; ///< seconds

    explicit BatchSize(uint32_t capacity) : _capacity(capacity), _paths(std::min(First, capacity)) {}

    /// Batches may take this many times as long as a host likes that somebody watches, 1 and more.
    void setPatience(double patience) { _patience = patience; }

    uint32_t paths() const { return _paths; }
    /// Reports a batch: how many paths it had and how long it took.
    void report(uint32_t paths, double seconds) {
        if (seconds > Long * _patience && paths >= _paths / 2)
            _paths = std::max(_paths / 2, std::min(Smallest, _capacity));
        if (seconds < Short * _patience && paths >= _paths / 2) _paths = std::min(2 * _paths, _capacity);
    }

private:
    uint32_t _capacity, _paths;
    double _patience = 1.0;
};

} // namespace hipr
