// What a recording writes.
#include <algorithm>
#include <cstdio>

#include "plugin/record/cryptomatte.h"
#include "plugin/record/recording.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

std::string Recording::outputPath(const Output& output, const FrameReport& report) const {
    const std::string path = output.path(report.frame);
    if (_options.editsFile.empty()) return path;
    return editPath(path, report.edit > 0 ? _edits[size_t(report.edit) - 1] : Edit(), _edits.size());
}

void Recording::write(FrameReport& report) {
    if (!_outputs.empty()) writePictures(report);
    if (!_options.dumpFile.empty()) writeDump(report);
    if (_options.memory) std::fputs(memoryTable(report.stats).c_str(), stdout);
    std::fflush(stdout);
}

void Recording::writePictures(FrameReport& report) {
    HdRenderDelegate& delegate = _engine.delegate();
    const bool paused = !report.converged && delegate.IsPauseSupported() && delegate.Pause();
    const bool denoised = std::count(_options.aovs.begin(), _options.aovs.end(), "denoised") > 0;
    if (denoised && !report.converged) _engine.publishNow();
    Picture picture = _engine.read();
    if (paused) delegate.Resume();
    for (Layer& layer : picture.layers) {
        layer.half = _options.half;
        const auto named = _options.layerNames.find(layer.aov);
        if (named != _options.layerNames.end()) layer.name = named->second;
        const std::string matte = cryptomatteOf(layer.aov);
        if (!matte.empty() && !picture.info.names.count(matte))
            picture.info.names[matte] = _engine.cryptomatteNames(matte);
    }
    picture.info.software = std::string("hiprrecord " HIPR_VERSION ", ") + _report.renderer;
    picture.info.scene = _report.scene;
    picture.info.camera = _report.camera;
    picture.info.settings = _report.settings;
    picture.info.frame = report.frame;
    picture.info.samples = report.samples;
    picture.info.seconds = report.seconds;
    for (const Output& output : _outputs) {
        const std::string path = outputPath(output, report);
        output.write(path, picture, _display);
        report.files.push_back(path);
        if (_options.verbosity != Verbosity::Quiet)
            std::fprintf(stderr, "wrote %s (%d x %d, %ld samples, %s)\n", path.c_str(), picture.width,
                         picture.height, report.samples, durationText(report.seconds).c_str());
    }
}

void Recording::writeDump(const FrameReport& report) {
    const bool toFile = _options.dumpFile != "-";
    writeText(toFile ? outputPath(Output(_options.dumpFile), report) : "-", _engine.sceneDump());
}

void Recording::finish() const {
    if (!_options.statsFile.empty()) writeText(_options.statsFile, reportJson(_report));
}

} // namespace hipr::record
