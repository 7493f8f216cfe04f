// What RendererImpl does about splats.
#include "renderer/scene/camera.h"
#include "renderer/trace/renderer_impl.h"

namespace hipr {

bool RendererImpl::complete() const {
    return _schedule.samplesDone() >= uint32_t(_settings.samples) && firstHitsDone() && !_splats.pending();
}

/// Splats may have come, gone, moved or changed.
void RendererImpl::updateSplats() {
    _splats.setScene(_scene.splats(), _scene.splatPlacements());
    if (_film.keepDepths(_splats.present())) {
        _firstHitsDone = 0;
        _splatDepths = false;
    }
    _setupPending = true;
    awaitSplats();
}

/// The camera or the film is another one.
void RendererImpl::viewSplats() {
    _splatDepths = false;
    if (!_scene.camera()) return;
    if (const std::optional<gpu::CameraRecord> camera = cameraRecord(*_scene.camera()))
        _splats.setView(*camera, _film.width(), _film.height());
}

/// Splats that are to be drawn again leave a finished picture unfinished.
void RendererImpl::awaitSplats() {
    if (!_splats.pending()) return;
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress.converged = false;
}

bool RendererImpl::renderSplats() {
    const auto start = Clock::now();
    if (!_splats.render(_cancel)) return false;
    count(0, std::chrono::duration<double>(Clock::now() - start).count());
    return !complete();
}

} // namespace hipr
