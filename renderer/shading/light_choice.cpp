#include "renderer/shading/light_choice.h"

#include <algorithm>
#include <cmath>

namespace hipr {

double roundedPower(double power) {
    return std::exp2(std::round(std::log2(std::min(std::max(power, 1e-30), 1e30))));
}

std::vector<double> lightChances(const std::vector<double>& powers) {
    constexpr double Uniform = 0.1;
    std::vector<double> chances;
    double total = 0.0;
    for (const double power : powers) {
        chances.push_back(power > 0.0 ? roundedPower(power) : 0.0);
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
