/// @file edit_scheduler.h
/// After an edit: finds the tiles in which it shows and puts them in order. See docs/hipr.md.
#pragma once

#include <memory>

#include "renderer/hipr/schedule.h"
#include "renderer/hipr/schedule_log.h"
#include "renderer/hipr/survey.h"
#include "renderer/scene/gpu_scene.h"
#include "renderer/trace/film.h"
#include "renderer/trace/path_tracer.h"

namespace hipr {

/// Both modes ask scouts (Survey). In delta mode what they tell is the first order; from then on every tile's
/// first samples tell how much it changes, and that its neighbours may. In paper mode tiles in which they or
/// the first hits saw the edit are active: those are rendered first, one sample a pixel, and their paths and
/// shadow rays tell which tiles come next.
class EditScheduler {
public:
    EditScheduler(Device& device, GpuScene& scene, FilmBuffers& film, PathTracer& tracer,
                  TileSchedule& schedule, ScheduleLog& log)
        : _device(device), _scene(scene), _film(film), _tracer(tracer), _schedule(schedule), _log(log) {}

    /// Whether the settings ask for paper mode, which needs first hits of every picture.
    static bool discovers(const Settings& settings) { return settings.mode == "paper"; }
    /// To be called when settings change. Compiles what paper mode needs, in the background.
    void prepare(const Settings& settings);
    /// Whether all that the mode needs is compiled; waits up to `patience` for it.
    bool ready(std::chrono::milliseconds patience) { return !_passes || _passes->ready(patience); }
    /// For gpu::TraceRecord::discovery.
    VkDeviceAddress address() const { return _passes ? _passes->address() : 0; }

    /// An edit: `changed` is committed and `boxes` are where changed objects were and are.
    void start(const Settings& settings, const gpu::CameraRecord& camera, const ChangedSet& changed,
               const std::vector<WorldBox>& boxes);
    /// The camera moved and the picture on display, of that mean radiance, was carried along: batches of
    /// samples tell where it is better than they are.
    void followMove(const Settings& settings, float meanRadiance);
    /// An edit is about to start: the search under way ends, but what it has not looked at is not forgotten.
    void interrupt() { _phase = Phase::Idle; }
    /// The samples are invalid for another reason than an edit: there is nothing to look for.
    void stop();

    /// Whether search() has work, which comes before samples.
    bool searching() const { return _phase == Phase::Active || _phase == Phase::Survey; }
    /// Whether the first hits must be known for it.
    bool wantsFirstHits() const { return _phase == Phase::Active; }
    /// One batch of work of at most `maxPaths` paths. False when `cancel` was seen.
    bool search(uint32_t maxPaths, const std::atomic<bool>& cancel);
    /// Whether the order of the tiles is not known yet.
    bool busy() const { return _phase != Phase::Idle && _phase != Phase::Follow; }

    /// What batches of samples are to be traced with, if they are to discover.
    DiscoveryPasses* discovery() { return _phase == Phase::Discover ? _passes.get() : nullptr; }
    /// After a batch of samples: `done`, or abandoned.
    void traced(bool done);

    /// Delta mode: what batches of samples change is measured. For gpu::TraceRecord::changeScale; 0 when
    /// nobody asks for it.
    float changeScale() const;
    /// What a batch changed in its tiles; before the schedule goes on.
    void measured(const std::vector<gpu::TileWork>& tiles, const std::vector<gpu::TileChange>& changes);

    uint64_t scoutPaths() const { return _survey.pathsTraced(); }

private:
    enum class Phase { Idle, Active, Survey, Discover, Follow };

    void findActive();
    bool scout(uint32_t maxPaths, const std::atomic<bool>& cancel);
    void finishSurvey();
    void startDiscovery();
    void order(const std::vector<float>& priorities);

    Device& _device;
    GpuScene& _scene;
    FilmBuffers& _film;
    PathTracer& _tracer;
    TileSchedule& _schedule;
    ScheduleLog& _log;
    std::unique_ptr<DiscoveryPasses> _passes; ///< once paper mode was asked for

    Phase _phase = Phase::Idle;
    uint32_t _edits = 0;
    float _radiance = 0.f; ///< mean of the picture, while batches are measured
    bool _moved = false;   ///< by a camera: samples from before are of another view
    Settings _settings;    ///< of the edit
    gpu::CameraRecord _camera{};
    Survey _survey;
    std::vector<gpu::ScoutResult> _scoutResults;
    ChangedElements _changed; ///< since tiles were last marked active
    std::vector<uint32_t> _active;
    std::vector<uint64_t> _weights;
};

} // namespace hipr
