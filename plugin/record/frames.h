/// @file frames.h
/// Frame ranges and numbered file names.
#pragma once

#include <string>
#include <vector>

namespace hipr::record {

/// Parses "7", "1:10", "1:10x2", "10:1x-3", "1:2x0.25" and comma-separated lists of these into time codes, in
/// the order written. The end of a range is included when a step lands on it; a range that runs backwards
/// steps by -1 unless told otherwise. Throws std::invalid_argument with the reason for anything else, and for
/// more than a million frames.
std::vector<double> parseFrames(const std::string& text);

/// A file name with an optional frame number placeholder: "out.####.exr", or "out.##.###.exr" where the
/// second group of hashes takes the fraction. Only the last path component may hold one.
class FramePattern {
public:
    /// Throws std::invalid_argument for two separate placeholders.
    explicit FramePattern(const std::string& path);

    bool hasPlaceholder() const { return _whole > 0; }
    /// Whether the pattern tells fractional frames apart.
    bool hasFraction() const { return _fraction > 0; }
    /// The file name of a frame; zero-padded to at least as many digits as there are hashes.
    std::string path(double frame) const;

private:
    std::string _before, _after;
    int _whole = 0, _fraction = 0; ///< number of hashes
};

} // namespace hipr::record
