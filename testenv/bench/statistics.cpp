#include "testenv/bench/statistics.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include <sys/resource.h>

namespace hipr::bench {

Spread spread(std::vector<double> values) {
    if (values.empty()) return {};
    std::sort(values.begin(), values.end());
    const size_t n = values.size();
    return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

std::string text(double value, int digits) {
    std::ostringstream out;
    out << std::fixed << std::setprecision(digits) << value;
    return out.str();
}

std::string text(const Spread& s, int digits) {
    return text(s.median, digits) + " (" + text(s.minimum, digits) + "-" + text(s.maximum, digits) + ")";
}

double processorSeconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

nlohmann::json toJson(const Spread& s) {
    return {{"median", s.median}, {"min", s.minimum}, {"max", s.maximum}};
}

} // namespace hipr::bench
