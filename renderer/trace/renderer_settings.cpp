// How RendererImpl takes settings and films.
#include <algorithm>

#include <tbb/info.h>

#include "renderer/scene/camera.h"
#include "renderer/trace/renderer_impl.h"

namespace hipr {
namespace {

/// Whether a picture under way with settings `a` goes on under `b`.
bool samePicture(const Settings& a, const Settings& b) {
    Settings c = a;
    c.samples = b.samples;
    c.timeLimit = b.timeLimit;
    c.threadLimit = b.threadLimit;
    c.interactive = b.interactive;
    c.traversal = b.traversal;             // all traversals report the same hits
    c.framesPerSecond = b.framesPerSecond; // what moves by it is sent anew
    c.mode = b.mode;                       // what is rendered first is no part of the picture
    c.tileSize = b.tileSize;
    c.scoutRate = b.scoutRate;
    c.floorShare = b.floorShare;
    c.eps = b.eps;
    c.weightSpecular = b.weightSpecular;
    c.weightGlossy = b.weightGlossy;
    c.weightDiffuse = b.weightDiffuse;
    c.weightTransmission = b.weightTransmission;
    c.weightDirect = b.weightDirect;
    c.weightIndirect = b.weightIndirect;
    c.weightCaustic = b.weightCaustic;
    c.splatMode = b.splatMode; // splats are no part of the samples
    c.splatAntialiasing = b.splatAntialiasing;
    c.splatColors = b.splatColors;
    if (pilotSamples(a) == 0)                            // which looks at what is displayed
        c.exposureCompensation = b.exposureCompensation; // nor is what they are multiplied by
    return c == b && pilotSamples(a) == pilotSamples(b);
}

ChangedSet settingChange() {
    return {{{std::monostate(), Change::Setting}}};
}

} // namespace

/// Not from within the arena.
void RendererImpl::limitThreads(int limit) {
    const int all = tbb::info::default_concurrency();
    const int threads = limit > 0 ? std::min(limit, all) : std::max(1, all + limit);
    if (threads == _arena.max_concurrency()) return;
    _arena.terminate();
    _arena.initialize(threads);
}

std::optional<gpu::CameraRecord> RendererImpl::takingCamera() const {
    std::optional<gpu::CameraRecord> camera = cameraRecord(*_scene.camera());
    if (camera && !_settings.depthOfField) camera->lensX = camera->lensY = glm::vec3(0.f);
    return camera;
}

void RendererImpl::selectTraversal() {
    const bool timed = _scene.moves();
    const bool fits = _settings.traversal == _traversalInUse &&
                      (timed ? _scene.traversal().knowsTime() : !_traversalReplaced);
    if (fits) return;
    TraversalKind kind = defaultTraversal(*_device);
    if (_settings.traversal == "host") kind = TraversalKind::Host;
    if (_settings.traversal == "embree") kind = TraversalKind::Embree;
    if (_settings.traversal == "bvh") kind = TraversalKind::Bvh;
    if (_settings.traversal == "rayquery") kind = TraversalKind::RayQuery;
    const bool blind = kind == TraversalKind::RayQuery && _device->info().rayQuery && timed;
    if (blind) kind = TraversalKind::Bvh;
    if (blind && !_traversalReplaced)
        _device->messages()(
            Severity::Info, "",
            "ray query knows nothing of motion: while something moves, rays take a tree of our own");
    _traversalReplaced = blind;
    try {
        _scene.setTraversal(createTraversal(kind, *_device));
    } catch (const DeviceLost&) {
        throw;
    } catch (const std::runtime_error& e) {
        if (_settings.traversal == "auto") throw;
        _device->messages()(Severity::Error, "",
                            std::string(e.what()) + "; choosing a traversal by device instead");
        _scene.setTraversal(createTraversal(defaultTraversal(*_device), *_device));
    }
    _traversalInUse = _settings.traversal;
}

ChangedSet RendererImpl::setFilm(const FilmDesc& film) {
    ChangedSet changed;
    guarded([&] {
        if (film == _film.desc()) return true;
        _film.setDesc(film);
        if (_scene.keepNames(_film.wantsNames())) _scene.commit();
        restart(Cause::Picture);
        viewSplats(false);
        changed = settingChange();
        return true;
    });
    return changed;
}

ChangedSet RendererImpl::setSettings(const Settings& settings) {
    ChangedSet changed;
    limitThreads(settings.threadLimit);
    guarded([&] {
        const bool same = samePicture(_settings, settings);
        if (settings.mode != _settings.mode) _edits.stop();
        _settings = settings;
        prepareMode();
        _edits.prepare(settings);
        const bool discovers = EditScheduler::discovers(settings);
        _film.keepSpreads(settings.convergedVariance > 0.f);
        if (_film.keepHits(discovers)) findFirstHits(discovers);
        const std::string traversal = _traversalInUse;
        const bool options = _scene.setOptions(
            {settings.enableSceneLights, settings.enableSceneMaterials, settings.domeLightCameraVisibility,
             settings.motionBlur, settings.enableShadows, uint64_t(settings.textureMemory) << 20});
        selectTraversal();
        if (options || traversal != _traversalInUse) _scene.commit();
        _setupPending = true;
        _splats.setSettings(settings);
        updateSplats(); // motion blur may be another
        _schedule.setFloor(settings.floorShare);
        _batch.setPatience(settings.interactive ? 1.0 : 10.0);
        const bool tiles = tileSize() != _schedule.grid().tileSize;
        if (tiles)
            restart(Cause::Picture);
        else if (!same)
            restart(Cause::Everything);
        std::lock_guard<std::mutex> lock(_progressMutex);
        _progress.samplesTotal = uint32_t(settings.samples);
        if (tiles || !same) changed = settingChange();
        return true;
    });
    return changed;
}

uint32_t RendererImpl::tileSize() const {
    if (_internals.tileSize) return _internals.tileSize;
    const bool automatic = _settings.tileSize == "auto";
    return automatic ? automaticTileSize(_film.width(), _film.height())
                     : uint32_t(std::stoul(_settings.tileSize));
}

} // namespace hipr
