// What RendererImpl does about splats.
#include "renderer/scene/camera.h"
#include "renderer/trace/renderer_impl.h"

namespace hipr {

bool RendererImpl::complete() const {
    return sampled() && firstHitsDone() && !_splats.pending() && !_splats.blurring();
}

/// Whether no more samples are to be taken: all are, or time is up and every pixel has one.
bool RendererImpl::sampled() const {
    const uint32_t done = _schedule.samplesDone();
    const bool timeIsUp = _settings.timeLimit > 0.f && _progress.seconds >= double(_settings.timeLimit);
    return done >= uint32_t(_settings.samples) || (timeIsUp && done > 0);
}

/// Splats may have come, gone, moved or changed, and so may what hides them.
void RendererImpl::updateSplats() {
    if (_splatRevision != _scene.splatRevision()) {
        _splatRevision = _scene.splatRevision();
        _splats.setScene(_scene.splats(), _scene.splatPlacements());
    }
    if (_scene.camera()) _splats.setMotion(*_scene.camera(), _scene.shutter());
    if (_film.keepDepths(_splats.present() && _scene.anythingTraced())) {
        findFirstHits(_film.depths() != 0);
        if (!_film.depths()) _splats.setDepths(0);
        _splatDepths = false;
        _setupPending = true; // which tells where depths go
    }
    awaitSplats();
}

/// Whether splats wait to learn what hides them: nothing known yet is of this view, or has been carried to
/// it.
bool RendererImpl::depthsMissing() const {
    return _edits.wantsFirstHits() || (_splats.pending() && _film.depths() && !_splatDepths);
}

/// The camera or the film is another one. `carried`: the film's depths have been carried to it.
void RendererImpl::viewSplats(bool carried) {
    _splatDepths = carried && _film.depths();
    _splats.setDepths(_film.depths());
    if (!_scene.camera()) return;
    if (const std::optional<gpu::CameraRecord> camera = cameraRecord(*_scene.camera()))
        _splats.setView(*camera, _film.width(), _film.height());
}

/// Splats that are to be drawn again leave a finished picture unfinished.
void RendererImpl::awaitSplats() {
    if (!_splats.pending()) return;
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress.converged = _progress.firstHitsDone = false;
}

bool RendererImpl::renderSplats() {
    const auto start = Clock::now();
    if (!_splats.render(_cancel)) return false;
    _log.splats(!_film.depths() ? "none" : firstHitsDone() ? "current" : "earlier");
    count(0, std::chrono::duration<double>(Clock::now() - start).count());
    return !complete();
}

} // namespace hipr
