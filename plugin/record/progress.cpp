#include "plugin/record/progress.h"

#include <algorithm>
#include <cmath>

namespace hipr::record {

namespace {

constexpr auto terminalInterval = std::chrono::milliseconds(100);
constexpr auto lineInterval = std::chrono::seconds(10);
constexpr int barWidth = 30;

std::string format(const char* pattern, double a, double b = 0) {
    char text[64];
    std::snprintf(text, sizeof(text), pattern, a, b);
    return text;
}

} // namespace

std::string durationText(double seconds) {
    if (seconds < 59.95) return format("%.1f s", seconds);
    const double minutes = std::floor(seconds / 60.0);
    if (minutes < 60.0) return format("%.0f min %.0f s", minutes, std::floor(seconds - 60.0 * minutes));
    const double hours = std::floor(minutes / 60.0);
    return format("%.0f h %02.0f min", hours, minutes - 60.0 * hours);
}

std::string progressText(const ProgressState& state) {
    const double fraction = std::clamp(state.fraction, 0.0, 1.0);
    std::string text = format("%3.0f %%", std::floor(100.0 * fraction));
    if (state.samples > 0) text += ", " + std::to_string(state.samples) + " samples";
    text += ", " + durationText(state.seconds);
    if (fraction > 0.02 && fraction < 1.0 && state.seconds > 0.5)
        text += ", " + durationText(state.seconds * (1.0 - fraction) / fraction) + " left";
    return text;
}

void Progress::begin(const std::string& title) {
    _title = title;
    _drawn = _told = false;
}

void Progress::update(const ProgressState& state) {
    if (!_out) return;
    if (!_told && !_terminal && state.samples == 0) return;
    const auto now = Clock::now();
    const auto interval = _terminal ? Clock::duration(terminalInterval) : Clock::duration(lineInterval);
    if (_told && now - _last < interval) return;
    _told = true;
    _last = now;
    if (!_terminal) {
        std::fprintf(_out, "%s: %s\n", _title.c_str(), progressText(state).c_str());
    } else {
        const int filled = int(std::clamp(state.fraction, 0.0, 1.0) * barWidth);
        const std::string bar =
            std::string(size_t(filled), '=') + std::string(size_t(barWidth - filled), ' ');
        std::fprintf(_out, "\r\033[K%s [%s] %s", _title.c_str(), bar.c_str(), progressText(state).c_str());
        _drawn = true;
    }
    std::fflush(_out);
}

void Progress::end() {
    if (!_out || !_drawn) return;
    std::fputs("\r\033[K", _out);
    std::fflush(_out);
    _drawn = false;
}

} // namespace hipr::record
