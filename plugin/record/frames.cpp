#include "plugin/record/frames.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace hipr::record {

namespace {

constexpr size_t maxFrames = 1'000'000;

[[noreturn]] void reject(const std::string& text, const std::string& why) {
    throw std::invalid_argument("'" + text + "' is no frame range: " + why);
}

double parseNumber(const std::string& number, const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(number.c_str(), &end);
    if (number.empty() || *end != '\0' || !std::isfinite(value))
        reject(text, "'" + number + "' is no number");
    return value;
}

struct Range {
    double first, last, step;
};

Range parseRange(const std::string& text) {
    const size_t colon = text.find(':');
    if (colon == std::string::npos) {
        const double frame = parseNumber(text, text);
        return {frame, frame, 1.0};
    }
    const size_t cross = text.find('x', colon);
    const std::string last = text.substr(colon + 1, cross == std::string::npos ? cross : cross - colon - 1);
    Range range{parseNumber(text.substr(0, colon), text), parseNumber(last, text), 1.0};
    if (cross != std::string::npos)
        range.step = parseNumber(text.substr(cross + 1), text);
    else if (range.last < range.first)
        range.step = -1.0;
    if (range.step == 0.0) reject(text, "the step is 0");
    if ((range.last - range.first) * range.step < 0.0) reject(text, "the step leads away from the end");
    return range;
}

} // namespace

std::vector<double> parseFrames(const std::string& text) {
    std::vector<double> frames;
    std::istringstream parts(text);
    std::string part;
    while (std::getline(parts, part, ',')) {
        const Range range = parseRange(part);
        // A tenth of a step of slack, so that 0:1x0.1 has its end in spite of rounding.
        const double steps = std::floor((range.last - range.first) / range.step + 0.1);
        if (steps + double(frames.size()) >= double(maxFrames)) reject(text, "more than a million frames");
        for (size_t i = 0; i <= size_t(steps); ++i)
            frames.push_back(range.first + double(i) * range.step);
    }
    if (frames.empty() || text.back() == ',') reject(text, "a frame is missing");
    return frames;
}

FramePattern::FramePattern(const std::string& path) {
    const size_t name = path.find_last_of('/') + 1; // npos + 1 is 0
    const size_t begin = path.find('#', name);
    if (begin == std::string::npos) {
        _before = path;
        return;
    }
    size_t end = path.find_first_not_of('#', begin);
    if (end == std::string::npos) end = path.size();
    _whole = int(end - begin);
    if (path.compare(end, 2, ".#") == 0) {
        const size_t fraction = end + 1;
        end = path.find_first_not_of('#', fraction);
        if (end == std::string::npos) end = path.size();
        _fraction = int(end - fraction);
    }
    _before = path.substr(0, begin);
    _after = path.substr(end);
    if (_after.find('#') != std::string::npos)
        throw std::invalid_argument("'" + path + "' has more than one frame placeholder");
}

std::string FramePattern::path(double frame) const {
    if (!hasPlaceholder()) return _before;
    const int sign = frame < 0.0 ? 1 : 0;
    const int width = _whole + sign + (_fraction > 0 ? _fraction + 1 : 0);
    char number[512];
    std::snprintf(number, sizeof(number), "%0*.*f", width, _fraction, frame);
    return _before + number + _after;
}

} // namespace hipr::record
