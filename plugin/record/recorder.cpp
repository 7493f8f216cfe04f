#include "plugin/record/recorder.h"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <thread>
#include <unistd.h>

#include "plugin/record/engine.h"
#include "plugin/record/frames.h"
#include "plugin/record/progress.h"
#include "plugin/record/renderSettings.h"
#include "plugin/record/report.h"
#include "pxr/base/plug/registry.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

const char* const ownRenderer = "HiPR";
const char* const samplesKey = "numCompletedSamples"; // HdPerfTokens
constexpr auto pollInterval = std::chrono::milliseconds(10);

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - _start).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point _start = Clock::now();
};

class Recording {
public:
    Recording(const Options& options, const std::atomic<bool>& interrupted);
    ExitCode run();

private:
    void configureRenderer();
    void renderFrame(double frame, FrameReport& report);
    double progressFraction(const FrameReport& report) const;
    void writeFrame(FrameReport& report);
    void finish() const;

    const Options& _options;
    const std::atomic<bool>& _interrupted;
    std::vector<FramePattern> _outputs;
    DisplayOptions _display;
    RecordingReport _report;
    Engine _engine;
    Progress _progress;
};

void requireWritable(const std::string& path) {
    const std::string why = whyNotWritable(path);
    if (!why.empty()) throw Failure(ExitOutput, "cannot write '" + path + "': " + why);
}

DisplayOptions displayOptions(const Options& options) {
    ViewTransformDesc desc;
    const size_t slash = options.view.find('/');
    desc.display = slash == std::string::npos ? "" : options.view.substr(0, slash);
    desc.view = slash == std::string::npos ? options.view : options.view.substr(slash + 1);
    desc.exposure = options.exposure;
    const auto messages = [](Severity severity, const std::string& subject, const std::string& text) {
        const std::string message = subject.empty() ? text : subject + ": " + text;
        if (severity == Severity::Error)
            printError(message);
        else if (severity == Severity::Warning)
            printWarning(message);
    };
    std::string error;
    DisplayOptions display;
    display.alpha = options.alpha;
    display.view = ViewTransform::create(ColorManager::create(messages), desc, &error);
    if (!display.view) throw Failure(ExitUsage, "--view: " + error);
    return display;
}

Recording::Recording(const Options& options, const std::atomic<bool>& interrupted)
    : _options(options), _interrupted(interrupted), _display(displayOptions(options)),
      _engine(options.renderer, options.device),
      _progress(options.verbosity == Verbosity::Quiet ? nullptr : stderr, isatty(STDERR_FILENO)) {
    for (const std::string& output : options.outputs)
        _outputs.emplace_back(output);
    configureRenderer();
}

void Recording::configureRenderer() {
    HdRenderDelegate& delegate = _engine.delegate();
    const TfToken samples = HdRenderSettingsTokens->convergedSamplesPerPixel;
    if (_options.samples > 0 || _options.seconds > 0) {
        const int count = _options.samples > 0 ? _options.samples : 1 << 20;
        if (hasSetting(delegate, samples.GetString()))
            applySetting(delegate, samples.GetString(), std::to_string(count));
        else if (_options.samples > 0)
            printWarning("the renderer " + _engine.rendererName() + " does not let --samples choose");
    }
    for (const auto& [key, value] : _options.settings)
        applySetting(delegate, key, value);
    for (const std::string& aov : _options.aovs) {
        if (_engine.hasAov(aov)) continue;
        std::string message = "--aovs: the renderer has no AOV '" + aov + "'. Known AOVs:";
        for (const std::string& known : listAovs(_engine))
            message += " " + known;
        throw Failure(ExitUsage, message);
    }
}

/// Whether every pixel has a sample; renderers that do not count are trusted.
bool hasPicture(const FrameReport& report) {
    return statNumber(report.stats, samplesKey, 1.0) >= 1.0;
}

ExitCode Recording::run() {
    const Stopwatch opening;
    std::vector<std::string> mask = _options.mask;
    if (!mask.empty() && TfStringStartsWith(_options.camera, "/")) mask.push_back(_options.camera);
    const UsdStageRefPtr stage = openStage(_options.scene, mask);
    const std::vector<double> frames =
        _options.frames.empty() ? std::vector<double>{defaultFrame(stage)} : _options.frames;
    for (const FramePattern& output : _outputs)
        requireWritable(output.path(frames.front()));
    if (!_options.statsFile.empty() && _options.statsFile != "-") requireWritable(_options.statsFile);

    const View view = chooseView(stage, {_options.camera, _options.width, _options.height, _options.purposes},
                                 frames.front());
    _report.scene = _options.scene;
    _report.renderer = _engine.rendererName();
    _report.camera = view.automatic ? "auto" : view.camera.GetString();
    _report.settings = settingsSummary(_engine.delegate());
    _report.width = view.width;
    _report.height = view.height;
    _report.openSeconds = opening.seconds();

    if (_options.verbosity != Verbosity::Quiet)
        std::fprintf(stderr, "recording %s with %s: %d x %d, camera %s\n", _report.scene.c_str(),
                     _report.renderer.c_str(), view.width, view.height, _report.camera.c_str());
    _engine.populate(stage, view.camera,
                     {view.width, view.height, _options.aovs, _options.purposes, _options.refineLevel});
    for (size_t i = 0; i < frames.size() && !_interrupted; ++i) {
        FrameReport report;
        _progress.begin(frames.size() == 1
                            ? "rendering"
                            : TfStringPrintf("frame %g (%zu of %zu)", frames[i], i + 1, frames.size()));
        renderFrame(frames[i], report);
        if (_interrupted && !hasPicture(report)) break; // an empty file might replace a good one
        writeFrame(report);
        _report.frames.push_back(std::move(report));
    }
    finish();
    return _interrupted ? ExitInterrupted : ExitOk;
}

double Recording::progressFraction(const FrameReport& report) const {
    const VtValue target = VtValue::Cast<double>(
        _engine.delegate().GetRenderSetting(HdRenderSettingsTokens->convergedSamplesPerPixel));
    const double samples = target.GetWithDefault<double>(0.0);
    const double bySamples = samples > 0 ? 100.0 * double(report.samples) / samples : 0.0;
    const double fraction = statNumber(report.stats, "percentDone", bySamples) / 100.0;
    return _options.seconds > 0 ? std::max(fraction, report.seconds / _options.seconds) : fraction;
}

void Recording::renderFrame(double frame, FrameReport& report) {
    const Stopwatch watch;
    report.frame = frame;
    _engine.setFrame(frame);
    while (true) {
        report.converged = _engine.step();
        report.stats = _engine.stats();
        report.seconds = watch.seconds();
        report.samples = long(statNumber(report.stats, samplesKey, 0.0));
        if (report.samples > 0 && report.firstSampleSeconds < 0) report.firstSampleSeconds = report.seconds;
        if (report.converged || _interrupted) break;
        if (_options.seconds > 0 && report.seconds >= _options.seconds && hasPicture(report)) break;
        _progress.update({progressFraction(report), report.samples, report.seconds});
        std::this_thread::sleep_for(pollInterval);
    }
    _progress.end();
    // HiPR always counts samples; when it has no device there is nothing to count.
    const bool failed = _report.renderer == ownRenderer && report.stats.empty();
    if (report.converged && (failed || !hasPicture(report)))
        throw Failure(ExitRender, "the renderer " + _report.renderer + " stopped without a picture");
}

void Recording::writeFrame(FrameReport& report) {
    HdRenderDelegate& delegate = _engine.delegate();
    const bool paused = !report.converged && delegate.IsPauseSupported() && delegate.Pause();
    Picture picture = _engine.read();
    if (paused) delegate.Resume();
    picture.info.software = std::string("hiprrecord " HIPR_VERSION ", ") + _report.renderer;
    picture.info.scene = _report.scene;
    picture.info.camera = _report.camera;
    picture.info.settings = _report.settings;
    picture.info.frame = report.frame;
    picture.info.samples = report.samples;
    picture.info.seconds = report.seconds;
    for (const FramePattern& output : _outputs) {
        const std::string path = output.path(report.frame);
        writePicture(path, picture, _display);
        report.files.push_back(path);
        if (_options.verbosity != Verbosity::Quiet)
            std::fprintf(stderr, "wrote %s (%d x %d, %ld samples, %s)\n", path.c_str(), picture.width,
                         picture.height, report.samples, durationText(report.seconds).c_str());
    }
    if (_options.memory) std::fputs(memoryTable(report.stats).c_str(), stdout);
    std::fflush(stdout);
}

void Recording::finish() const {
    if (_options.statsFile.empty()) return;
    const std::string json = reportJson(_report);
    if (_options.statsFile == "-") {
        std::fputs(json.c_str(), stdout);
        return;
    }
    std::ofstream file(_options.statsFile);
    file << json;
    file.close();
    if (!file) throw Failure(ExitOutput, "cannot write '" + _options.statsFile + "'");
}

void printLines(const std::vector<std::string>& lines) {
    for (const std::string& line : lines)
        std::printf("%s\n", line.c_str());
}

void printLists(const Options& options) {
    if (options.listRenderers) printLines(listRenderers());
    if (options.listCameras)
        for (const SdfPath& camera : listCameras(openStage(options.scene, options.mask)))
            std::printf("%s\n", camera.GetText());
    if (!options.listSettings && !options.listAovs) return;
    const Engine engine(options.renderer, options.device);
    if (options.listSettings) std::fputs(describeSettings(engine.delegate()).c_str(), stdout);
    if (options.listAovs) printLines(listAovs(engine));
}

} // namespace

void registerPlugins() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path plugins = program.parent_path().parent_path() / "plugin" / "usd";
    if (!error && std::filesystem::is_directory(plugins, error))
        PlugRegistry::GetInstance().RegisterPlugins(plugins.string());
}

ExitCode record(const Options& options, const std::atomic<bool>& interrupted) {
    if (options.onlyLists()) {
        printLists(options);
        return ExitOk;
    }
    return Recording(options, interrupted).run();
}

} // namespace hipr::record
