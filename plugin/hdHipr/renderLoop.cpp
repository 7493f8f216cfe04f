#include "plugin/hdHipr/renderLoop.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "plugin/hdHipr/aov.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/pixelFormat.h"
#include "plugin/hdHipr/renderBuffer.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

/// Copying pictures costs time that sampling could use; nobody sees more of them than this.
constexpr std::chrono::milliseconds publishInterval{50};

/// Puts premultiplied colour over the colour the host clears with.
void compositeOver(std::vector<float>& rgba, GfVec4f const& background) {
    if (background == GfVec4f(0.f)) {
        return;
    }
    for (size_t i = 0; i + 3 < rgba.size(); i += 4) {
        const float through = 1.f - rgba[i + 3];
        for (size_t c = 0; c < 4; ++c) {
            rgba[i + c] += through * background[c];
        }
    }
}

/// What a film must have to fill the targets.
std::vector<hipr::AovRequest> aovsFor(std::vector<AovTarget> const& targets) {
    std::vector<hipr::AovRequest> aovs;
    const auto add = [&](hipr::AovRequest const& aov) {
        if (std::find(aovs.begin(), aovs.end(), aov) == aovs.end()) {
            aovs.push_back(aov);
        }
    };
    for (AovTarget const& target : targets) {
        if (target.denoised) {
            std::for_each(denoisingAovs().begin(), denoisingAovs().end(), add);
        } else if (target.aov) {
            add(*target.aov);
        }
    }
    return aovs;
}

} // namespace

RenderLoop::RenderLoop(std::unique_ptr<hipr::Renderer> renderer) : _renderer(std::move(renderer)) {
    _thread.SetRenderCallback([this] { run(); });
    _thread.StartThread();
}

RenderLoop::~RenderLoop() {
    stop();
    _thread.StopThread();
}

/// Called under _requestMutex.
void RenderLoop::changed() {
    ++_version;
    for (AovTarget const& target : _frame.targets) {
        target.buffer->setConverged(false);
    }
    if (_shown.load()) {
        _renderer->cancel();
    }
}

void RenderLoop::submitEdit(hipr::SceneEdit& edit) {
    if (edit.empty()) {
        return;
    }
    std::lock_guard<std::mutex> lock(_requestMutex);
    _edit.append(edit);
    changed();
}

void RenderLoop::submitSettings(hipr::Settings const& settings) {
    std::lock_guard<std::mutex> lock(_requestMutex);
    _settings = settings;
    changed();
}

void RenderLoop::submitTextureReload() {
    std::lock_guard<std::mutex> lock(_requestMutex);
    _reloadTextures = true;
    changed();
}

void RenderLoop::submitFrame(Frame const& frame) {
    std::lock_guard<std::mutex> lock(_requestMutex);
    const bool sameView = _frame.camera == frame.camera && _version.load() > 0;
    if (sameView && _frame.rect == frame.rect && _frame.targets == frame.targets) {
        return;
    }
    for (AovTarget const& target : frame.targets) {
        const auto& old = _frame.targets;
        if (std::find(old.begin(), old.end(), target) == old.end()) {
            target.buffer->clear(target.clearValue);
        }
    }
    if (!sameView) {
        _edit.setCamera(frame.camera);
    }
    _frame = frame;
    changed();
}

void RenderLoop::releaseBuffer(HdHiprRenderBuffer* buffer) {
    const std::scoped_lock lock(_publishMutex, _requestMutex);
    for (Frame* frame : {&_shownFrame, &_frame}) {
        auto& targets = frame->targets;
        targets.erase(std::remove_if(targets.begin(), targets.end(),
                                     [buffer](AovTarget const& target) { return target.buffer == buffer; }),
                      targets.end());
    }
}

void RenderLoop::kick() {
    if (!_stopped.load() && !converged() && !_thread.IsRendering()) {
        _thread.StartRender();
    }
}

void RenderLoop::pause() {
    _paused.store(true);
    _thread.PauseRender();
}

void RenderLoop::resume() {
    _paused.store(false);
    _thread.ResumeRender();
}

void RenderLoop::stop() {
    _stopped.store(true); // before cancel(): the loop looks at it after it has resumed the renderer
    _renderer->cancel();
    _thread.StopRender();
}

void RenderLoop::restart() {
    _stopped.store(false);
    kick();
}

LoopStats RenderLoop::stats() const {
    std::lock_guard<std::mutex> lock(_requestMutex);
    hipr::Progress progress = _renderer->progress();
    if (_committedVersion != _version.load()) {
        const uint32_t total = progress.samplesTotal;
        progress = {}; // what is told of is the picture asked for, not the one before
        progress.samplesTotal = total;
    }
    return {progress,
            _memory,
            _changes,
            _lastChanged.elements.size(),
            _lastChanged.kinds(),
            _denoising.seconds()};
}

hipr::ChangedSet RenderLoop::lastChanged() const {
    std::lock_guard<std::mutex> lock(_requestMutex);
    return _lastChanged;
}

void RenderLoop::whenIdle(std::function<void(hipr::Renderer&)> const& look) {
    _renderer->cancel();
    _thread.StopRender();
    _renderer->resume();
    pickUp(); // the render thread is idle
    look(*_renderer);
    kick();
}

/// Nothing may leave the render thread: it would end the host.
void RenderLoop::run() {
    try {
        if (!_broken) {
            renderRequests();
        }
    } catch (std::exception const& error) {
        _broken = true;
        report(hipr::Severity::Error, "", std::string("the render thread ended: ") + error.what());
    }
    if (_broken) {
        const std::scoped_lock lock(_publishMutex, _requestMutex);
        _pickedVersion = _version.load();
        converge();
    }
}

void RenderLoop::renderRequests() {
    _renderer->resume();
    while (!_stopped.load() && !_thread.IsStopRequested()) {
        if (_thread.IsPauseRequested()) {
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
            continue;
        }
        pickUp();
        if (_stopped.load()) {
            break;
        }
        showDenoised();
        const bool more = _renderer->renderBatch();
        const bool done = !more && !_renderer->cancelled();
        if (publish(done) && _everyBatch.load()) {
            waitUntilTaken();
        }
        if (done && finishDenoising() && finish()) {
            break;
        }
    }
}

void RenderLoop::pickUp() {
    hipr::SceneEdit edit;
    hipr::Settings settings;
    hipr::FilmDesc film;
    bool reload = false;
    {
        const std::scoped_lock lock(_publishMutex, _requestMutex);
        if (_pickedVersion == _version.load()) {
            return;
        }
        _pickedVersion = _version.load();
        _shown.store(false);
        _renderer->resume();
        edit.append(_edit);
        settings = _settings;
        _threadLimit = settings.threadLimit;
        reload = std::exchange(_reloadTextures, false);
        _denoisedShown &= _shownFrame.rect == _frame.rect && _shownFrame.targets == _frame.targets;
        _shownFrame = _frame;
        _firstHitsShown = false;
        _publishedPaths = 0;
        film.width = uint32_t(std::max(_frame.rect.width, 0));
        film.height = uint32_t(std::max(_frame.rect.height, 0));
        film.aovs = aovsFor(_frame.targets);
    }
    hipr::ChangedSet changed = _renderer->setSettings(settings);
    for (hipr::ChangedSet const& more : {_renderer->setFilm(film), _renderer->commit(edit),
                                         reload ? _renderer->reloadTextures() : hipr::ChangedSet()}) {
        changed.elements.insert(changed.elements.end(), more.elements.begin(), more.elements.end());
    }
    hipr::MemoryReport memory = _renderer->memory();
    std::lock_guard<std::mutex> lock(_requestMutex);
    _memory = std::move(memory);
    _committedVersion = _pickedVersion;
    if (!changed.empty()) {
        _lastChanged = std::move(changed);
        ++_changes;
    }
}

/// Returns whether the host can see a new picture.
bool RenderLoop::publish(bool last) {
    const auto now = std::chrono::steady_clock::now();
    const hipr::Progress progress = _renderer->progress();
    const bool fresh = progress.fraction > 0 && progress.pictureShown;
    const bool due = _everyBatch.load() ? progress.pathsTraced != _publishedPaths
                                        : !_shown.load() || now - _lastPublish >= publishInterval;
    if (!last && !(fresh && due)) {
        return false;
    }
    std::lock_guard<std::mutex> lock(_publishMutex);
    denoiseMeanwhile();
    for (AovTarget const& target : _shownFrame.targets) {
        if (target.denoised && (_denoisedShown || !target.buffer->taken())) {
            continue; // what follows is better, or nobody looks
        }
        const bool firstHit = target.aov && !changesWithSamples(target.aov->kind);
        if (!target.aov || (firstHit && (_firstHitsShown || !progress.firstHitsDone))) {
            continue;
        }
        publishTarget(target);
    }
    _firstHitsShown = progress.firstHitsDone;
    _lastPublish = now;
    _publishedPaths = progress.pathsTraced;
    _shown.store(true);
    ++_pictures;
    return true;
}

void RenderLoop::waitUntilTaken() {
    const auto taken = [this] {
        std::lock_guard<std::mutex> lock(_publishMutex);
        auto const& targets = _shownFrame.targets;
        return std::all_of(targets.begin(), targets.end(),
                           [](AovTarget const& target) { return target.buffer->taken(); });
    };
    while (_everyBatch.load() && !_stopped.load() && !_thread.IsStopRequested() &&
           !_thread.IsPauseRequested() && _pickedVersion == _version.load() && !taken()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void RenderLoop::publishTarget(AovTarget const& target) {
    if (_shownFrame.rect.width <= 0 || _shownFrame.rect.height <= 0) {
        return;
    }
    if (_renderer->readAov(*target.aov, nullptr, 0)) {
        return; // a film without pixels: the renderer refused a size for which there may be no memory here
                // either
    }
    const hipr::AovFormat format = hipr::aovFormat(target.aov->kind);
    _scratch.resize(size_t(_shownFrame.rect.width) * size_t(_shownFrame.rect.height) * format.components);
    if (!_renderer->readAov(*target.aov, _scratch.data(), _scratch.size())) {
        return;
    }
    if (target.aov->kind == hipr::AovKind::Color) {
        return writeColor(target, _scratch);
    }
    target.buffer->write(_shownFrame.rect, _scratch.data(), format.components, format.integer,
                         target.clearValue);
}

void RenderLoop::writeColor(AovTarget const& target, std::vector<float>& pixels) {
    compositeOver(pixels, clearComponents(target.clearValue));
    target.buffer->write(_shownFrame.rect, pixels.data(), 4, false, target.clearValue);
}

/// Declares the picture converged unless a newer request has come in. Returns whether there is nothing left
/// to do.
bool RenderLoop::finish() {
    std::lock_guard<std::mutex> lock(_requestMutex);
    if (_pickedVersion != _version.load()) {
        return false;
    }
    converge();
    return true;
}

/// Called under _requestMutex.
void RenderLoop::converge() {
    for (AovTarget const& target : _frame.targets) {
        target.buffer->setConverged(true);
    }
    _convergedVersion.store(_pickedVersion);
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
