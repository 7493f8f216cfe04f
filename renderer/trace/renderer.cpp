#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>

#include "renderer/scene/camera.h"
#include "renderer/trace/renderer_impl.h"

namespace hipr {
namespace {

void printMessage(Severity severity, const std::string& subject, const std::string& text) {
    const char* level = severity == Severity::Error     ? "error: "
                        : severity == Severity::Warning ? "warning: "
                                                        : "";
    std::cerr << "hipr: " << level << subject << (subject.empty() ? "" : ": ") << text << std::endl;
}

std::vector<unsigned char> readFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Position of an enum setting's value among its choices.
uint32_t choiceIndex(const char* setting, const std::string& value) {
    for (const SettingInfo& info : settingTable())
        for (size_t i = 0; i < info.choices.size(); ++i)
            if (std::string(info.name) == setting && info.choices[i] == value) return uint32_t(i);
    return 0;
}

/// The first batch after an edit that shows in less than this share of the tiles has this share of the
/// pixels.
constexpr double NarrowEdit = 0.5, EditBatchShare = 1.0 / 32;
constexpr uint32_t SmallestEditBatch = 2048, EditBatchDoublings = 5;

/// Adaptive sampling: samples that tell how many more a tile needs. Those of all its pixels together make a
/// good estimate.
constexpr uint32_t PilotSamples = 8;
constexpr double MostSamples = 1 << 30;
/// On display, errors of darker pixels than this count as if they were as bright; 1 is white.
constexpr float DarkestRadiance = 0.1f;

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

bool anyCamera(const ChangedSet& changed) {
    return std::any_of(changed.elements.begin(), changed.elements.end(),
                       [](const ChangedElement& element) { return element.change & Change::Camera; });
}

/// Whether samples must be taken again although the view is the same.
bool lensChanged(const std::optional<CameraDesc>& before, const std::optional<CameraDesc>& now) {
    return before && now && !before->sameSamples(*now);
}

/// Whether adaptive sampling sees another picture.
bool exposureChanged(const std::optional<CameraDesc>& before, const std::optional<CameraDesc>& now) {
    return before && now && before->exposure != now->exposure;
}

} // namespace

/// Adaptive sampling pays only where there are many more samples to save than the pilot costs.
uint32_t pilotSamples(const Settings& settings) {
    const bool adaptive = settings.convergedVariance > 0.f && uint32_t(settings.samples) >= 2 * PilotSamples;
    return adaptive ? PilotSamples : 0;
}

RendererImpl::RendererImpl(MachinePtr machine, const RendererOptions& options,
                           const RendererInternals& internals)
    : _machine(std::move(machine)), _device(_machine->device.get()), _internals(internals),
      _scene(*_device, options.assets), _film(*_device, _scene.names()), _tracer(_machine->tracer),
      _edits(*_device, _scene, _film, _tracer, _schedule, _log), _splats(*_device, _machine->splats),
      _batch(_tracer.capacity()) {
    prepareMode();
    selectTraversal();
    _scene.commit();
}

void RendererImpl::fail(const char* reason) {
    _failed = true;
    finish();
    try {
        _device->messages()(Severity::Error, "", std::string(reason) + "; rendering stops");
    } catch (const std::bad_alloc&) { // not even for a message; Progress tells it as well
    }
}

/// Hosts that wait for convergence must not wait for what will never come.
void RendererImpl::finish() {
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress.converged = true;
    _progress.failed = _failed;
}

ChangedSet RendererImpl::commit(SceneEdit& edit) {
    return commitChanges([&] { return _scene.apply(edit.take()); });
}

ChangedSet RendererImpl::reloadTextures() {
    return commitChanges([&] { return _scene.reloadTextures(); });
}

/// `apply` changes the scene and says what.
ChangedSet RendererImpl::commitChanges(const std::function<ChangedSet()>& apply) {
    ChangedSet changed;
    guarded([&] {
        const std::optional<CameraDesc> before = _scene.camera();
        changed = apply();
        if (changed.empty()) return true;
        const bool camera = anyCamera(changed) && !(before && before->sameView(*_scene.camera()));
        const bool traced = _scene.tracedChanged() || lensChanged(before, _scene.camera()) ||
                            (_schedule.pilot() > 0 && exposureChanged(before, _scene.camera()));
        std::vector<WorldBox> regions = _scene.takeVacated();
        selectTraversal();
        _tracer.prepareFor(_scene.shadingFeatures() | _film.shadingFeatures());
        _scene.commit();
        _scene.addOccupied(changed, regions);
        if (camera || traced) restart(camera ? Cause::Camera : Cause::Edit);
        if (camera)
            viewSplats(moveCamera(before, regions));
        else if (traced)
            startSearch(changed, regions);
        updateSplats();
        return true;
    });
    return changed;
}

void RendererImpl::restart(Cause cause) {
    const TileGrid grid(_film.width(), _film.height(), tileSize());
    _schedule.setPilot(pilotSamples(_settings));
    if (cause == Cause::Picture)
        _schedule.reset(grid);
    else
        _schedule.invalidate();
    if (cause != Cause::Edit) {
        _schedule.forgetPriorities();
        _schedule.changeView();
    }
    _schedule.setFloor(_settings.floorShare);
    retireHits(cause);
    _setupPending = true;
    _restarted = Clock::now();
    _batchesSinceRestart = 0;
    findFirstHits(true);
    const char* names[] = {"picture", "edit", "camera", "everything"};
    _log.restart(names[int(cause)], grid);
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress = {};
    _progress.samplesTotal = uint32_t(_settings.samples);
    _progress.tiles = grid.count();
    _progress.pictureShown = _schedule.everythingShown();
}

/// What was seen and what had changed before an edit stay of interest until discovery has looked at them.
void RendererImpl::retireHits(Cause cause) {
    if (cause == Cause::Edit) {
        _edits.interrupt();
        if (firstHitsDone()) _film.retireHits();
    } else {
        _edits.stop();
        _film.dropPreviousHits();
    }
}

/// Looks for the tiles in which an edit shows. `regions`: where objects that changed were and are.
void RendererImpl::startSearch(const ChangedSet& changed, const std::vector<WorldBox>& regions) {
    if (!_scene.camera()) return;
    if (const std::optional<gpu::CameraRecord> camera = takingCamera())
        _edits.start(_settings, *camera, changed, regions);
}

/// Tells the path tracer what to render. False: there is nothing to render.
bool RendererImpl::setup() {
    if (!_scene.camera() || _film.pixels() == 0) return false;
    const std::optional<gpu::CameraRecord> camera = takingCamera();
    if (!camera && !_cameraReported)
        _device->messages()(Severity::Error, "",
                            "the camera's matrices cannot be inverted; nothing is rendered");
    _cameraReported = !camera;
    if (!camera) return false;
    if (!_setupPending) return true;
    gpu::TraceRecord record{};
    _film.describe(record);
    record.scene = _scene.address();
    record.maxDepth = uint32_t(_settings.maxDepth);
    record.rouletteDepth = uint32_t(_settings.rouletteDepth);
    record.pixelFilter = choiceIndex("hipr:pixelFilter", _settings.pixelFilter);
    record.filterWidth = _settings.filterWidth;
    record.fireflyClamp = _settings.fireflyClamp;
    record.seed = uint32_t(_settings.seed);
    record.pilot = _schedule.pilot();
    if (record.pilot > 0)
        record.seed ^= gpu::SECOND_SET_SEED; // the second set is that of pictures without a pilot
    record.darkest = DarkestRadiance / std::max(cameraExposure(), std::numeric_limits<float>::min());
    record.discovery = _edits.address();
    record.changeScale = _edits.changeScale();
    record.moving = _scene.moves();
    record.frameTime = float(_scene.shutter().frame());
    record.filtersTextures = _settings.textureFiltering;
    _tracer.setup(record, _film.lightPaths(), *camera,
                  cameraKeys(*_scene.camera(), *camera, _scene.shutter()),
                  _scene.flags() | _film.shadingFeatures());
    _setupPending = false;
    return true;
}

bool RendererImpl::renderBatch() {
    return guarded([&] {
        if (cancelled()) return false;
        if (!setup()) return finish(), false;
        // Compiling may take seconds; the host stays in charge meanwhile.
        if (!_tracer.ready(std::chrono::milliseconds(50))) return true;
        if (!_edits.ready(std::chrono::milliseconds(50))) return true;
        if (_schedule.everythingShown() && !readyToMove(std::chrono::milliseconds(50))) return true;
        if (_splats.pending() && !_splats.ready(std::chrono::milliseconds(50))) return true;
        if (depthsMissing() && !firstHitsDone()) return renderFirstHits();
        if (_splats.pending()) return renderSplats();
        if (_splats.blurring() && (!_film.depths() || firstHitsDone())) return renderSplats();
        if (_edits.searching()) return search();
        if (complete()) return finish(), false;
        const bool firstHits = !firstHitsDone() && (sampled() || _schedule.discoveredRefreshed());
        return firstHits ? renderFirstHits() : renderSamples();
    });
}

/// Looks further for the tiles in which an edit shows.
bool RendererImpl::search() {
    const auto start = Clock::now();
    const bool done = _edits.search(batchPaths(), _cancel);
    _setupPending |= !_edits.searching(); // what batches are to measure
    count(0, secondsSince(start));
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress.scoutPaths = _edits.scoutPaths();
    _progress.scheduleSeconds += secondsSince(start);
    return done;
}

/// Who wants first hits, or what for, has changed, or with `anew` what they are.
void RendererImpl::findFirstHits(bool anew) {
    if (!_film.wantsFirstHits())
        _firstHitsDone = _film.pixels();
    else if (anew)
        _firstHitsDone = 0;
}

bool RendererImpl::renderFirstHits() {
    const auto start = Clock::now();
    const uint32_t pixels = uint32_t(std::min<uint64_t>(_batch.paths(), _film.pixels() - _firstHitsDone));
    if (!_tracer.findFirstHits(_scene.traversal(), uint32_t(_firstHitsDone), pixels, _cancel)) return false;
    _firstHitsDone += pixels;
    if (firstHitsDone() && _film.depths()) {
        _splatDepths = true;
        _splats.setDepths(_film.depths());
    }
    count(0, secondsSince(start));
    if (!_edits.wantsFirstHits()) return true;
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress.scheduleSeconds += secondsSince(start);
    return true;
}

/// Paths of the next batch. Small at first while a few discovered tiles wait for their first sample: what
/// matters most shows soon, and its samples tell where to go on. From the second on each is twice as large as
/// the one before, for small batches fill a device badly, and where an edit goes on and on, order matters
/// less and less.
uint32_t RendererImpl::samplePaths() const {
    const bool fewWait = !_schedule.discoveredRefreshed() &&
                         _schedule.discoveredTiles() < NarrowEdit * _schedule.grid().count();
    const uint32_t some = std::max(SmallestEditBatch, uint32_t(EditBatchShare * double(_film.pixels())));
    const uint32_t doublings = std::min(std::max(_batchesSinceRestart, 1u) - 1, EditBatchDoublings);
    return fewWait ? std::min(batchPaths(), some << doublings) : batchPaths();
}

/// The variance of a mean is that of one sample over their number. The samples that the pilot took are no
/// part of the mean: what decided how many there are must not be in it, or pixels that happened to miss a
/// light would keep that for good (D. Kirk and J. Arvo, "Unbiased Sampling Techniques for Image Synthesis",
/// 1991).
void RendererImpl::learnFromPilots(const std::vector<gpu::TileWork>& tiles) {
    const uint32_t pilot = _schedule.pilot();
    for (size_t i = 0; pilot > 0 && i < tiles.size(); ++i) {
        const gpu::TileWork& work = tiles[i];
        if (work.firstSample + work.sampleCount != pilot) continue;
        const double variance =
            double(_tileChanges[i].variance) / (double(gpu::VARIANCE_STEPS) * work.width * work.height);
        const double samples = std::ceil(variance / double(_settings.convergedVariance));
        _schedule.want(_schedule.grid().at(work.x, work.y), uint32_t(std::min(samples, MostSamples)));
    }
}

bool RendererImpl::renderSamples() {
    const auto start = Clock::now();
    const uint32_t samples = uint32_t(_settings.samples);
    const std::vector<gpu::TileWork>& tiles = _schedule.next(samplePaths(), samples);
    const uint32_t paths = _schedule.pathCount();
    if (!tiles.empty()) {
        const bool watched = _edits.changeScale() > 0.f || _schedule.pilot() > 0;
        const bool done = _tracer.trace(_scene.traversal(), tiles, paths, _cancel, _edits.discovery(),
                                        watched ? &_tileChanges : nullptr);
        if (!done) return _edits.traced(false), false;
        ++_batchesSinceRestart;
        _edits.measured(tiles, _tileChanges);
        learnFromPilots(tiles);
        _schedule.advance();
        _log.batch(tiles, paths, _schedule);
        _edits.traced(true);
        _batch.report(paths, secondsSince(start));
    }
    count(paths, secondsSince(start));
    return !complete();
}

void RendererImpl::count(uint32_t paths, double seconds) {
    const gpu::TraceCounters counters = _tracer.takeCounters();
    if (counters.nonFinite && !_nonFiniteReported) {
        _nonFiniteReported = true;
        _device->messages()(
            Severity::Warning, "",
            "some light paths came out as NaN or infinity and were dropped; a texture, primvar or light "
            "probably holds such values");
    }
    std::lock_guard<std::mutex> lock(_progressMutex);
    _progress.samplesDone = _schedule.samplesDone();
    _progress.tilesDiscovered = _edits.busy() ? 0 : _schedule.discoveredTiles();
    _progress.pathsTraced += paths;
    _progress.nearestRays += counters.rays[0] + counters.rays[2];
    _progress.shadowRays += counters.rays[1];
    _progress.raysTraced = _progress.nearestRays + _progress.shadowRays;
    _progress.seconds += seconds;
    _progress.fraction = double(_schedule.pathsDone()) /
                         std::max(1.0, double(_schedule.pathsWanted(uint32_t(_settings.samples))));
    _progress.pictureShown = _schedule.everythingShown();
    _progress.firstHitsDone = firstHitsDone() && !_splats.pending(); // the ids of splats are among them
    if (paths && _progress.firstRevealSeconds == 0) _progress.firstRevealSeconds = secondsSince(_restarted);
    _progress.converged = complete();
}

Progress RendererImpl::progress() const {
    std::lock_guard<std::mutex> lock(_progressMutex);
    return _progress;
}

MemoryReport RendererImpl::memory() const {
    MemoryReport report = _device->memory();
    report.rows.push_back({"Host: meshes", _scene.meshHostBytes()});
    report.rows.push_back({"Host: splats", _scene.splatHostBytes()});
    report.rows.push_back({"Host: volumes", _scene.volumeHostBytes()});
    report.rows.push_back({"Host: acceleration structures", _scene.traversalHostBytes()});
    return report;
}

std::unique_ptr<RendererImpl> createRenderer(const RendererOptions& options,
                                             const RendererInternals& internals, std::string* error) {
    RendererOptions complete = options;
    if (!complete.messages) complete.messages = printMessage;
    if (!complete.assets) complete.assets = readFile;
    try {
        MachinePtr machine = makeMachine(complete, internals.batchPaths, error);
        if (!machine) return nullptr;
        return std::make_unique<RendererImpl>(std::move(machine), complete, internals);
    } catch (const std::exception& e) {
        if (error) *error = reasonOf(e);
        return nullptr;
    }
}

std::unique_ptr<Renderer> Renderer::create(const RendererOptions& options, std::string* error) {
    return createRenderer(options, {}, error);
}

} // namespace hipr
