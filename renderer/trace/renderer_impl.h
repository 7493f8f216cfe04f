/// @file renderer_impl.h
/// The Renderer: scene, film, schedule and path tracer put together.
#pragma once

#include <chrono>
#include <functional>
#include <mutex>

#include <tbb/task_arena.h>

#include "renderer/api/renderer.h"
#include "renderer/hipr/schedule.h"
#include "renderer/hipr/schedule_log.h"
#include "renderer/scene/gpu_scene.h"
#include "renderer/trace/batch_size.h"
#include "renderer/trace/edit_scheduler.h"
#include "renderer/trace/film.h"
#include "renderer/trace/machine.h"
#include "renderer/trace/splat_layer.h"

namespace hipr {

/// What tests vary to show that it makes no difference, and see to judge the device.
struct RendererInternals {
    uint32_t tileSize = 0;   ///< 0: as Settings::tileSize says
    uint32_t batchPaths = 0; ///< exact size of every batch; 0: steered by time
};

class RendererImpl : public Renderer {
public:
    RendererImpl(MachinePtr machine, const RendererOptions& options, const RendererInternals& internals);

    const DeviceInfo& device() const override { return _device->info(); }
    ChangedSet commit(SceneEdit& edit) override;
    ChangedSet reloadTextures() override;
    ChangedSet setFilm(const FilmDesc& film) override;
    ChangedSet setSettings(const Settings& settings) override;
    bool renderBatch() override;
    Progress progress() const override;
    bool readAov(const AovRequest& aov, void* dst, size_t words) override;
    MemoryReport memory() const override;
    std::vector<std::string> cryptomatteNames(AovKind kind) const override {
        return _scene.cryptomatteNames(kind);
    }
    void dumpScene(std::ostream& out) const override { _scene.dump(out, _settings); }

    bool validation() const { return _device->validation(); }
    uint64_t validationErrors() const { return _device->validationErrors(); }
    const Settings& settings() const { return _settings; }

private:
    using Clock = std::chrono::steady_clock;
    /// What made the samples of the picture invalid.
    enum class Cause { Picture, Edit, Camera, Everything };

    template <class F> bool guarded(F&& work);
    ChangedSet commitChanges(const std::function<ChangedSet()>& apply);
    void fail(const char* reason);
    void finish();
    void restart(Cause cause);
    void retireHits(Cause cause);
    void prepareMode();
    bool readyToMove(std::chrono::milliseconds patience);
    bool moveCamera(const std::optional<CameraDesc>& before, const std::vector<WorldBox>& regions);
    void startSearch(const ChangedSet& changed, const std::vector<WorldBox>& regions);
    uint32_t tileSize() const;
    bool setup();
    void selectTraversal();
    void limitThreads(int limit);
    bool search();
    bool renderFirstHits();
    void updateSplats();
    void viewSplats(bool carried);
    bool depthsMissing() const;
    void findFirstHits(bool anew);
    void awaitSplats();
    bool renderSplats();
    bool complete() const;
    bool sampled() const;
    bool firstHitsDone() const { return _firstHitsDone >= _film.pixels(); }
    bool renderSamples();
    void learnFromPilots(const std::vector<gpu::TileWork>& tiles);
    float cameraExposure() const;
    /// The camera that samples are taken with: as the settings want it. None: its matrices cannot be
    /// inverted.
    std::optional<gpu::CameraRecord> takingCamera() const;
    void scaleColors(float* pixels, size_t components, float scale) const;
    uint32_t batchPaths() const { return _internals.batchPaths ? _internals.batchPaths : _batch.paths(); }
    uint32_t samplePaths() const;
    void count(uint32_t paths, double seconds);

    tbb::task_arena _arena; ///< of all work on the host
    MachinePtr _machine;    ///< outlives everything below
    Device* _device;
    RendererInternals _internals;
    Settings _settings;
    std::string _traversalInUse;
    bool _traversalReplaced = false; ///< by one that knows the time
    GpuScene _scene;
    FilmBuffers _film;
    TileSchedule _schedule;
    ScheduleLog _log;
    PathTracer& _tracer;
    EditScheduler _edits;
    SplatLayer _splats;
    std::vector<gpu::TileChange> _tileChanges; ///< of the last batch, if somebody asks
    BatchSize _batch;
    bool _failed = false, _setupPending = true, _nonFiniteReported = false, _cameraReported = false;
    Clock::time_point _restarted;
    uint32_t _batchesSinceRestart = 0;
    uint64_t _firstHitsDone = 0; ///< pixels
    bool _splatDepths = false;   ///< the film's depths are of this view, or carried to it
    uint64_t _splatRevision = 0; ///< of the scene's splats, as given to the layer
    mutable std::mutex _progressMutex;
    Progress _progress;
};

/// Samples of the pilot that settings ask for; see TileSchedule::setPilot().
uint32_t pilotSamples(const Settings& settings);

/// Runs `work`. What escapes it ends the renderer's life with one message: false is all callers see from then
/// on.
template <class F> bool RendererImpl::guarded(F&& work) {
    if (_failed) return false;
    try {
        return _arena.execute(work);
    } catch (const std::exception& e) {
        fail(reasonOf(e));
    }
    return false;
}

/// Renderer::create() for tests.
std::unique_ptr<RendererImpl> createRenderer(const RendererOptions& options,
                                             const RendererInternals& internals, std::string* error);

} // namespace hipr
