// What RendererImpl does when the camera moves.
#include "renderer/hipr/footprint.h"
#include "renderer/hipr/staleness.h"
#include "renderer/scene/camera.h"
#include "renderer/trace/renderer_impl.h"

namespace hipr {
namespace {

/// What carrying itself makes wrong everywhere, in mean radiances: edges are off by up to half a pixel.
constexpr float CarryError = 0.03f;

} // namespace

void RendererImpl::prepareMode() {
    const bool edits = _settings.mode != "uniform";
    if (edits && !_machine->reprojection) _machine->reprojection = std::make_unique<Reprojection>(*_device);
    _schedule.keepPictures(edits);
    _film.keepPictures(edits);
}

/// Whether a camera move would find its kernels compiled; waits up to `patience` for them.
bool RendererImpl::readyToMove(std::chrono::milliseconds patience) {
    return _settings.mode == "uniform" || _machine->reprojection->ready(patience);
}

/// The picture on display stays, but where the new camera sees what it shows; what is least right about it is
/// refreshed first. `before`: the camera it is of. `regions`: where objects that changed as well were and
/// are. False: nothing was carried.
bool RendererImpl::moveCamera(const std::optional<CameraDesc>& before, const std::vector<WorldBox>& regions) {
    if (_settings.mode == "uniform" || !before || !_schedule.anythingShown()) return false;
    if (!readyToMove(std::chrono::milliseconds(0))) return false;
    const auto from = cameraRecord(*before), to = cameraRecord(*_scene.camera());
    if (!from || !to) return false;
    const auto start = Clock::now();
    std::vector<gpu::CarriedStrip> strips;
    if (!_film.carry(*_machine->reprojection, _schedule, *from, *to, strips)) return false;
    Staleness stale = staleness(_schedule.grid(), strips);
    std::vector<float>& errors = stale.errors;
    const float worst = *std::max_element(errors.begin(), errors.end());
    for (const WorldBox& box : regions)
        forTilesSeeing(_schedule.grid(), *to, box, [&](uint32_t tile) { errors[tile] = worst; });
    _schedule.carried(errors, CarryError * stale.meanRadiance);
    _edits.followMove(_settings, stale.meanRadiance);
    _log.order(_schedule);
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress.tilesDiscovered = _schedule.discoveredTiles();
    _progress.scheduleSeconds += std::chrono::duration<double>(Clock::now() - start).count();
    return true;
}

} // namespace hipr
