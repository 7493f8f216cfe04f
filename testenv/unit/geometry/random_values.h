/// What random descriptions of shapes are made of.
#pragma once

#include <random>
#include <vector>

namespace hipr::test {

class RandomValues {
protected:
    /// `odd`: what a number is instead, with the chance `oddChance`.
    RandomValues(uint32_t seed, double oddChance, std::vector<float> odd)
        : _random(seed), _oddChance(oddChance), _odd(std::move(odd)) {}

    int integer(int low, int high) { return std::uniform_int_distribution<int>(low, high)(_random); }
    bool chance(double p) { return std::bernoulli_distribution(p)(_random); }
    float number() {
        if (chance(_oddChance)) return _odd[size_t(integer(0, int(_odd.size()) - 1))];
        return std::uniform_real_distribution<float>(-2.f, 2.f)(_random);
    }
    /// Coarse, so that points coincide and polygons degenerate now and then.
    float coordinate() { return chance(0.3) ? float(integer(-1, 1)) : number(); }

private:
    std::mt19937 _random;
    double _oddChance;
    std::vector<float> _odd;
};

} // namespace hipr::test
