#include "renderer/shading/light_choice.h"

#include <cmath>

namespace hipr {

std::vector<double> lightChances(const std::vector<double>& powers) {
    constexpr double Uniform = 0.1;
    std::vector<double> chances;
    double total = 0.0;
    for (const double power : powers) {
        chances.push_back(power > 0.0 ? std::exp2(std::round(std::log2(power))) : 0.0);
        total += chances.back();
    }
    for (double& chance : chances)
        chance = total > 0.0 ? (1.0 - Uniform) * chance / total + Uniform / double(chances.size())
                             : 1.0 / double(chances.size());
    return chances;
}

std::vector<float> cumulativeChances(const std::vector<double>& chances) {
    std::vector<float> sums;
    double sum = 0.0;
    for (const double chance : chances)
        sums.push_back(float(sum += chance));
    if (!sums.empty()) sums.back() = 1.f;
    return sums;
}

} // namespace hipr
