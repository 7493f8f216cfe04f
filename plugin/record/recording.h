/// @file recording.h
/// One recording: its stage, renderer, frames and files.
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "plugin/record/editFrames.h"
#include "plugin/record/edits.h"
#include "plugin/record/engine.h"
#include "plugin/record/failure.h"
#include "plugin/record/options.h"
#include "plugin/record/outputs.h"
#include "plugin/record/progress.h"
#include "plugin/record/report.h"
#include "plugin/record/stage.h"

namespace hipr::record {

/// When to stop before the picture has converged; 0: no such limit.
struct Limit {
    int samples = 0;
    double seconds = 0;
};

class Recording {
public:
    /// `edits` are those of --edits.
    Recording(const Options& options, const std::vector<Edit>& edits, const std::atomic<bool>& interrupted);
    /// Records all frames and writes their files. Throws Failure.
    ExitCode run();

private:
    void configureRenderer();
    bool waitedFor() const;
    void open();
    void recordFrames();
    void recordEdits();
    Limit limitBefore(size_t edit) const;
    void apply(const Edit& edit);
    bool applyRequests(const Edit& edit);
    void render(FrameReport& report, const Limit& limit);
    bool takeBatch(const FrameReport& report);
    double progressFraction(const FrameReport& report, const Limit& limit) const;
    void write(FrameReport& report);
    void writePictures(FrameReport& report);
    void writeDump(const FrameReport& report);
    std::string outputPath(const Output& output, const FrameReport& report) const;
    void finish() const;

    const Options& _options;
    const std::vector<Edit>& _edits;
    const std::atomic<bool>& _interrupted;
    std::vector<Output> _outputs;
    DisplayOptions _display;
    RecordingReport _report;
    PXR_NS::UsdStageRefPtr _stage;
    std::vector<double> _frames;
    View _view;
    Engine _engine;
    Progress _progress;
    std::unique_ptr<EditFrames> _editFrames;
    double _picturesTaken = 0; ///< of those that the renderer has published
    int _batch = 0;            ///< in the picture under way
};

} // namespace hipr::record
