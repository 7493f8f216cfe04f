/// @file editFrames.h
/// Pictures of a recording with edits: one file per edit, and one per batch of work.
#pragma once

#include <fstream>
#include <string>

#include "plugin/record/edits.h"
#include "plugin/record/images.h"

namespace hipr::record {

/// The file of an edit: its number, as wide as that of the last edit, and its name go before the extension.
/// "out.png" becomes "out.2.move-the-ball.png".
std::string editPath(const std::string& path, const Edit& edit, size_t editCount);

/// How far the picture was after a batch.
struct BatchInfo {
    int edit = 0;       ///< 0: before any
    std::string name;   ///< of the edit
    int batch = 0;      ///< counted from the edit, from 1
    double seconds = 0; ///< of rendering since the edit
    long samples = 0;   ///< that every pixel has
    uint64_t paths = 0; ///< traced since the edit
};

/// A folder of numbered PNG files, and frames.jsonl with one JSON object per file.
class EditFrames {
public:
    /// Makes the folder. Throws Failure with ExitOutput.
    EditFrames(const std::string& folder, const DisplayOptions& display);
    /// Throws Failure with ExitOutput.
    void add(const Picture& picture, const BatchInfo& info);

private:
    std::string _folder;
    const DisplayOptions& _display;
    std::ofstream _list;
    int _count = 0;
};

} // namespace hipr::record
