/// @file outputs.h
/// The files of a recording.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "plugin/record/frames.h"
#include "plugin/record/images.h"
#include "plugin/record/options.h"

namespace hipr::record {

/// A file to write for each frame or edit.
class Output {
public:
    /// A file that may hold a frame placeholder, with all layers.
    explicit Output(const std::string& path) : _pattern(path) {}
    explicit Output(const ProductFile& file);

    std::string path(double frame) const;
    /// Writes what the file shows of a picture, which must have its AOVs. Throws Failure with ExitOutput.
    void write(const std::string& path, const Picture& picture, const DisplayOptions& display) const;

private:
    FramePattern _pattern;
    std::map<double, std::string> _pathAtFrame;
    std::vector<LayerName> _layers; ///< empty: all
};

/// All files that the options ask for.
std::vector<Output> outputsOf(const Options& options);

} // namespace hipr::record
