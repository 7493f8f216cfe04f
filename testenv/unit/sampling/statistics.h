/// @file statistics.h
#pragma once

#include <vector>

namespace hipr::test {

/// Pearson's chi-square test: the probability of counts as far from `expected` as these, or farther, if they
/// were drawn with those expectations. Bins expected below 5 are pooled; a count where nothing is expected
/// gives 0.
double chiSquareProbability(const std::vector<double>& counts, const std::vector<double>& expected);

/// Upper regularised incomplete gamma function Q(a, x).
double gammaQ(double a, double x);

} // namespace hipr::test
