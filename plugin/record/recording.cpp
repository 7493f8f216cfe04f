#include "plugin/record/recording.h"

#include <chrono>
#include <cstdio>
#include <thread>
#include <unistd.h>

#include "plugin/record/dataWindow.h"
#include "plugin/record/lists.h"
#include "plugin/record/materialCycles.h"
#include "plugin/record/renderSettings.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/imaging/hd/tokens.h"
#include "pxr/usd/usdGeom/camera.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

const char* const ownRenderer = "HiPR";
const char* const samplesKey = "numCompletedSamples"; // HdPerfTokens
constexpr auto pollInterval = std::chrono::milliseconds(10), batchPollInterval = std::chrono::milliseconds(1);

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(Clock::now() - _start).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point _start = Clock::now();
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

/// Whether every pixel has a sample; renderers that do not count are trusted.
bool hasPicture(const FrameReport& report) {
    return statNumber(report.stats, samplesKey, 1.0) >= 1.0;
}

} // namespace

Recording::Recording(const Options& options, const std::vector<Edit>& edits,
                     const std::atomic<bool>& interrupted)
    : _options(options), _edits(edits), _interrupted(interrupted), _outputs(outputsOf(options)),
      _display(displayOptions(options)), _engine(options.renderer, options.device),
      _progress(options.verbosity == Verbosity::Quiet ? nullptr : stderr, isatty(STDERR_FILENO)) {
    configureRenderer();
}

void Recording::configureRenderer() {
    HdRenderDelegate& delegate = _engine.delegate();
    for (const auto& [key, value] : _options.sceneSettings)
        if (hasSetting(delegate, key))
            applySetting(delegate, key, value);
        else if (TfStringStartsWith(key, "hipr:"))
            printWarning("the render settings of the scene set '" + key +
                         "', which the renderer does not have");
    const TfToken samples = HdRenderSettingsTokens->convergedSamplesPerPixel;
    if (_options.samples > 0 || _options.seconds > 0) {
        const int count = _options.samples > 0 ? _options.samples : 1 << 20;
        if (hasSetting(delegate, samples.GetString()))
            applySetting(delegate, samples.GetString(), std::to_string(count));
        else if (_options.samples > 0)
            printWarning("the renderer " + _engine.rendererName() + " does not let --samples choose");
    }
    if (_options.threads > 0 && hasSetting(delegate, "threadLimit"))
        applySetting(delegate, "threadLimit", std::to_string(_options.threads));
    for (const auto& [key, value] : _options.settings)
        applySetting(delegate, key, value);
    const std::string missing = _options.denoise ? _engine.whyMissing("denoised") : "";
    if (!missing.empty()) throw Failure(ExitUsage, "--denoise: " + missing);
    for (const std::string& aov : _options.aovs) {
        if (_engine.hasAov(aov)) continue;
        std::string message = "--aovs: the renderer has no AOV '" + aov + "'. Known AOVs:";
        for (const std::string& known : listAovs(_engine))
            message += " " + known;
        throw Failure(ExitUsage, message);
    }
}

ExitCode Recording::run() {
    open();
    if (_options.editsFile.empty() && _options.editFramesFolder.empty())
        recordFrames();
    else
        recordEdits();
    finish();
    return _interrupted ? ExitInterrupted : ExitOk;
}

/// Whether the renderer is to answer at once: edits and the end of a time are.
bool Recording::waitedFor() const {
    return !_options.editsFile.empty() || !_options.editFramesFolder.empty() || _options.seconds > 0;
}

/// The stage, its camera, and all of it in the renderer.
void Recording::open() {
    const Stopwatch opening;
    std::vector<std::string> mask = _options.mask;
    if (!mask.empty() && TfStringStartsWith(_options.camera, "/")) mask.push_back(_options.camera);
    _stage = openStage(_options.scene, mask);
    auto chosen = _options.settings;
    chosen.insert(chosen.end(), _options.sceneSettings.begin(), _options.sceneSettings.end());
    applyDefault(_engine.delegate(), "hipr:framesPerSecond", std::to_string(_stage->GetTimeCodesPerSecond()),
                 chosen);
    if (!waitedFor()) applyDefault(_engine.delegate(), "enableInteractive", "false", chosen);
    _frames = _options.frames.empty() ? std::vector<double>{defaultFrame(_stage)} : _options.frames;
    FrameReport first;
    first.frame = _frames.front();
    for (const Output& output : _outputs)
        requireWritable(outputPath(output, first));
    if (!_options.dumpFile.empty() && _options.dumpFile != "-")
        requireWritable(outputPath(Output(_options.dumpFile), first));
    if (!_options.statsFile.empty() && _options.statsFile != "-") requireWritable(_options.statsFile);
    if (!_options.editFramesFolder.empty()) {
        _editFrames = std::make_unique<EditFrames>(_options.editFramesFolder, _display);
        _engine.publishEveryBatch();
    }

    _view = chooseView(_stage, {_options.camera, _options.width, _options.height, _options.purposes},
                       _frames.front());
    _report.scene = _options.scene;
    _report.renderer = _engine.rendererName();
    _report.camera = _view.automatic ? "auto" : _view.camera.GetString();
    _report.settings = settingsSummary(_engine.delegate());
    _report.width = _view.width;
    _report.height = _view.height;
    _report.openSeconds = opening.seconds();

    if (_options.verbosity != Verbosity::Quiet && !_options.onlyDump())
        std::fprintf(stderr, "recording %s with %s: %d x %d, camera %s\n", _report.scene.c_str(),
                     _report.renderer.c_str(), _view.width, _view.height, _report.camera.c_str());
    EngineOptions engine{_view.width, _view.height, _options.aovs, _options.purposes};
    engine.conformPolicy = _options.conformPolicy;
    engine.pixelAspect = _options.pixelAspect;
    engine.refineLevel = _options.refineLevel;
    if (_options.crop) engine.window = dataWindowOf(*_options.crop, _view.width, _view.height);
    _engine.populate(_stage, _view.camera, engine);
}

void Recording::recordFrames() {
    for (size_t i = 0; i < _frames.size() && !_interrupted; ++i) {
        FrameReport report;
        report.frame = _frames[i];
        _progress.begin(_frames.size() == 1
                            ? "rendering"
                            : TfStringPrintf("frame %g (%zu of %zu)", _frames[i], i + 1, _frames.size()));
        render(report, {0, _options.seconds});
        if (_interrupted && !hasPicture(report)) break; // an empty file might replace a good one
        write(report);
        _report.frames.push_back(std::move(report));
    }
}

void Recording::recordEdits() {
    for (size_t i = 0; i <= _edits.size() && !_interrupted; ++i) {
        FrameReport report;
        report.edit = int(i);
        report.editName = i > 0 ? _edits[i - 1].name : "";
        if (i > 0) apply(_edits[i - 1]);
        report.frame = _frames.front();
        _progress.begin(i > 0 ? _edits[i - 1].title() : "before any edit");
        render(report, limitBefore(i));
        if (hasPicture(report) || (i > 0 && !_interrupted))
            write(report);
        else if (!_interrupted)
            printWarning("no picture was done before the first edit: there is no file of it");
        _report.frames.push_back(std::move(report));
    }
}

/// How long the scene after `edit` edits is rendered.
Limit Recording::limitBefore(size_t edit) const {
    if (edit == _edits.size()) return {0, _options.seconds};
    const Edit& next = _edits[edit];
    if (next.afterSamples) return {*next.afterSamples, 0};
    if (next.afterSeconds) return {0, std::max(*next.afterSeconds, 1e-9)}; // 0 would be no limit
    return {0, _options.seconds};
}

void Recording::apply(const Edit& edit) {
    bool changed = applyEdit(_stage, edit);
    if (!edit.usda.empty()) cutMaterialCycles(_stage);
    try {
        changed = applyRequests(edit) || changed;
    } catch (const Failure& failure) {
        throw Failure(failure.code(), edit.title() + ": " + failure.what());
    }
    if (!changed) printWarning(edit.title() + " changes nothing");
}

/// What an edit asks of the recorder. Returns whether that changes anything.
bool Recording::applyRequests(const Edit& edit) {
    HdRenderDelegate& delegate = _engine.delegate();
    const unsigned int settingsBefore = delegate.GetRenderSettingsVersion();
    for (const auto& [key, value] : edit.settings)
        applySetting(delegate, key, value);
    bool changed = delegate.GetRenderSettingsVersion() != settingsBefore;
    if (changed) _report.settings = settingsSummary(delegate);
    if (edit.time) {
        changed |= *edit.time != _frames.front();
        _frames.front() = *edit.time;
    }
    if (!edit.camera.empty()) {
        const SdfPath before = _view.camera;
        _view =
            chooseView(_stage, {edit.camera, _view.width, _view.height, _options.purposes}, _frames.front());
        _report.camera = _view.automatic ? "auto" : _view.camera.GetString();
        changed |= _view.camera != before;
        _engine.setCamera(_view.camera);
    }
    if (!UsdGeomCamera(_stage->GetPrimAtPath(_view.camera)))
        throw Failure(ExitCamera, "the camera " + _view.camera.GetString() +
                                      " is gone; name another one with \"camera\"");
    return changed;
}

double Recording::progressFraction(const FrameReport& report, const Limit& limit) const {
    const VtValue target = VtValue::Cast<double>(
        _engine.delegate().GetRenderSetting(HdRenderSettingsTokens->convergedSamplesPerPixel));
    const double samples = limit.samples > 0 ? limit.samples : target.GetWithDefault<double>(0.0);
    const double bySamples = samples > 0 ? double(report.samples) / samples : 0.0;
    const double fraction =
        limit.samples > 0 ? bySamples : statNumber(report.stats, "percentDone", 100.0 * bySamples) / 100.0;
    return limit.seconds > 0 ? std::max(fraction, report.seconds / limit.seconds) : fraction;
}

void Recording::render(FrameReport& report, const Limit& limit) {
    const Stopwatch watch;
    _batch = 0;
    _engine.setFrame(report.frame);
    while (true) {
        report.converged = _engine.step();
        if (_options.onlyDump()) return; // all of the scene is in the renderer
        report.stats = _engine.stats();
        report.seconds = watch.seconds();
        report.samples = long(statNumber(report.stats, samplesKey, 0.0));
        if (report.samples > 0 && report.firstSampleSeconds < 0) report.firstSampleSeconds = report.seconds;
        const bool tookBatch = takeBatch(report);
        if (report.converged || _interrupted) break;
        if (limit.samples > 0 && report.samples >= limit.samples) break;
        const bool timeIsUp = limit.seconds > 0 && report.seconds >= limit.seconds;
        if (timeIsUp && (report.edit >= 0 || hasPicture(report))) break; // edits wait for nothing
        _progress.update({progressFraction(report, limit), report.samples, report.seconds});
        if (!tookBatch) std::this_thread::sleep_for(_editFrames ? batchPollInterval : pollInterval);
    }
    _progress.end();
    // HiPR always counts samples; when it has no device there is nothing to count. It also tells when it gave
    // up.
    const bool failed = _report.renderer == ownRenderer &&
                        (report.stats.empty() || statNumber(report.stats, "hipr:failed", 0.0) > 0.0);
    if (report.converged && (failed || !hasPicture(report)))
        throw Failure(ExitRender, "the renderer " + _report.renderer + " stopped without a picture");
}

/// Adds the picture of a batch to --edit-frames, if there is a new one.
bool Recording::takeBatch(const FrameReport& report) {
    if (!_editFrames) return false;
    const double pictures = statNumber(report.stats, "hipr:pictures", 0.0);
    if (pictures == _picturesTaken) return false;
    _picturesTaken = pictures;
    const Picture picture = _engine.read(); // also lets the renderer go on
    BatchInfo info{report.edit, report.editName, 0, 0, report.samples, 0};
    info.seconds = statNumber(report.stats, "totalClockTime", 0.0);
    info.paths = uint64_t(statNumber(report.stats, "hipr:paths", 0.0));
    if (info.paths == 0) return true; // still the scene before the edit
    info.batch = ++_batch;
    _editFrames->add(picture, info);
    return true;
}

} // namespace hipr::record
