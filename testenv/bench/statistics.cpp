#include "testenv/bench/statistics.h"

#include <algorithm>

namespace hipr::bench {

Spread spread(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

nlohmann::json toJson(const Spread& s) {
    return {{"median", s.median}, {"min", s.minimum}, {"max", s.maximum}};
}

} // namespace hipr::bench
