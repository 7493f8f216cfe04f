/// @file report.h
/// What is told about a recording afterwards: statistics as JSON, memory as a table.
#pragma once

#include <string>
#include <vector>

#include "pxr/base/vt/dictionary.h"

namespace hipr::record {

/// A number among render statistics, of any numeric type; `fallback` when it is not there.
double statNumber(const PXR_NS::VtDictionary& stats, const std::string& key, double fallback);

struct FrameReport {
    double frame = 0;
    int edit = -1; ///< its number, 0 before the first; -1: the recording has no edits
    std::string editName;
    double seconds = 0; ///< from the scene edit to the last sample
    double firstSampleSeconds =
        -1;                 ///< until one sample per pixel was done; -1 when the renderer does not tell
    long samples = 0;       ///< per pixel
    bool converged = false; ///< false when time ran out or the recording was interrupted
    std::vector<std::string> files;
    PXR_NS::VtDictionary stats; ///< of the renderer
};

struct RecordingReport {
    std::string scene, renderer, camera, settings;
    int width = 0, height = 0;
    double openSeconds = 0; ///< to open the stage
    std::vector<FrameReport> frames;
};

std::string reportJson(const RecordingReport& report);

/// A line "kind  amount" for each statistic that has "memory" in its name, largest first; one line that says
/// so when the renderer reports none.
std::string memoryTable(const PXR_NS::VtDictionary& stats);

/// Writes text to a file, or to standard output for "-". Throws Failure with ExitOutput.
void writeText(const std::string& path, const std::string& text);

} // namespace hipr::record
