#include "testenv/unit/sampling/statistics.h"

#include <cmath>
#include <limits>

namespace hipr::test {

namespace {

/// P(a, x) by its power series; converges fast for x < a + 1.
double gammaPSeries(double a, double x) {
    double term = 1.0 / a, sum = term;
    for (double n = a + 1.0; std::abs(term) > std::abs(sum) * 1e-15; n += 1.0)
        sum += term *= x / n;
    return sum * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

/// Q(a, x) by its continued fraction (modified Lentz); converges fast for x > a + 1.
double gammaQFraction(double a, double x) {
    constexpr double Tiny = std::numeric_limits<double>::min();
    double b = x + 1.0 - a, c = 1.0 / Tiny, d = 1.0 / b, h = d;
    for (int i = 1; i < 100000; ++i) {
        const double an = -i * (i - a);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (std::abs(d * c - 1.0) < 1e-15) break;
    }
    return h * std::exp(-x + a * std::log(x) - std::lgamma(a));
}

} // namespace

double gammaQ(double a, double x) {
    if (x <= 0.0) return 1.0;
    return x < a + 1.0 ? 1.0 - gammaPSeries(a, x) : gammaQFraction(a, x);
}

double chiSquareProbability(const std::vector<double>& counts, const std::vector<double>& expected) {
    double chi = 0.0, pooledCount = 0.0, pooledExpected = 0.0;
    int bins = 0;
    const auto add = [&](double count, double wanted) {
        chi += (count - wanted) * (count - wanted) / wanted;
        ++bins;
    };
    for (size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] <= 0.0 && counts[i] > 0.0) return 0.0;
        if (expected[i] >= 5.0) {
            add(counts[i], expected[i]);
        } else {
            pooledCount += counts[i];
            pooledExpected += expected[i];
        }
    }
    if (pooledExpected >= 5.0) add(pooledCount, pooledExpected);
    return bins < 2 ? 1.0 : gammaQ(0.5 * (bins - 1), 0.5 * chi);
}

} // namespace hipr::test
