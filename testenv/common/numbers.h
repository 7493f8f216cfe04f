/// @file numbers.h
/// Random numbers that are the same on every machine.
#pragma once

#include <cstdint>

namespace hipr::test {

/// Depend on the seed alone.
class Numbers {
public:
    explicit Numbers(uint64_t seed) : _state(seed * 2862933555777941757ull + 3037000493ull) {}
    /// Uniform between lo and hi.
    float operator()(float lo, float hi) {
        _state = _state * 6364136223846793005ull + 1442695040888963407ull;
        return lo + (hi - lo) * float(_state >> 40) / float(1 << 24);
    }

private:
    uint64_t _state;
};

} // namespace hipr::test
