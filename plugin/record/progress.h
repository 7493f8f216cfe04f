/// @file progress.h
/// Tells a person how far a frame is: a bar on a terminal, a line now and then elsewhere.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace hipr::record {

/// How far a frame is.
struct ProgressState {
    double fraction = 0; ///< 0 to 1
    long samples = 0;    ///< per pixel; 0 when unknown
    double seconds = 0;  ///< since the frame began
};

/// The text after the bar: percent, samples, time, and time left when it can be told (after 2 % and half a
/// second).
std::string progressText(const ProgressState& state);
/// "8.4 s", "3 min 20 s" or "2 h 05 min".
std::string durationText(double seconds);

class Progress {
public:
    /// Writes to `out`; `terminal` draws a bar over itself, else there is a line at the first sample and then
    /// one every ten seconds. A null `out` is silent.
    Progress(std::FILE* out, bool terminal) : _out(out), _terminal(terminal) {}

    void begin(const std::string& title);
    void update(const ProgressState& state);
    /// Clears the bar.
    void end();

private:
    using Clock = std::chrono::steady_clock;
    std::FILE* _out;
    bool _terminal;
    bool _drawn = false; ///< a bar stands on the current line
    bool _told = false;  ///< something was shown since begin()
    std::string _title;
    Clock::time_point _last;
};

} // namespace hipr::record
