#include "renderer/trace/edit_scheduler.h"

#include <algorithm>

#include "renderer/hipr/footprint.h"

namespace hipr {
namespace {

/// Share of the tiles beyond which an edit shows nearly everywhere.
constexpr double WideEdit = 0.5;
/// Least change that scouts must see in and around a tile to make it active, in mean radiances.
constexpr float SeedChange = 0.02f;
/// Steps of gpu::TileChange in one mean radiance of the picture.
constexpr float StepsPerRadiance = 1024.f;
/// A tile whose samples changed by less than this, in mean radiances, says nothing of its neighbours.
constexpr float LeastChange = 0.01f;
/// What a tile is expected to change by, as a share of a neighbour's change.
constexpr float NeighbourShare = 0.5f;

} // namespace

void EditScheduler::prepare(const Settings& settings) {
    if (discovers(settings) && !_passes)
        _passes = std::make_unique<DiscoveryPasses>(_device, _tracer.capacity());
}

void EditScheduler::stop() {
    _phase = Phase::Idle;
    _changed.clear();
}

void EditScheduler::followMove(const Settings& settings, float meanRadiance) {
    _settings = settings;
    _radiance = meanRadiance;
    _moved = true;
    _phase = meanRadiance > 0.f ? Phase::Follow : Phase::Idle;
}

void EditScheduler::start(const Settings& settings, const gpu::CameraRecord& camera,
                          const ChangedSet& changed, const std::vector<WorldBox>& boxes) {
    _phase = Phase::Idle;
    if (settings.mode == "uniform" || !_schedule.everythingShown()) return _changed.clear();
    _settings = settings;
    _camera = camera;
    _survey.begin(_schedule.grid(), settings.scoutRate, ++_edits, discovers(settings));
    if (!discovers(settings)) {
        for (const WorldBox& box : boxes)
            forTilesSeeing(_schedule.grid(), camera, box, [&](uint32_t tile) { _survey.suspect(tile); });
        _phase = Phase::Survey;
        return;
    }
    _changed.add(_scene.keys(changed), boxes);
    _passes->begin(_schedule.grid(), _changed, _film.previousHits(), settings, _survey.pixelsPerScout());
    _weights.clear();
    _phase = Phase::Active;
}

bool EditScheduler::search(uint32_t maxPaths, const std::atomic<bool>& cancel) {
    if (_phase == Phase::Survey) return scout(maxPaths, cancel);
    findActive();
    return true;
}

void EditScheduler::findActive() {
    _tracer.findActive(*_passes, uint32_t(_film.pixels()));
    _active = _passes->activeTiles();
    if (!_film.previousHits()) // nobody knows what was seen where the objects have been
        for (const WorldBox& box : _changed.boxes())
            forTilesSeeing(_schedule.grid(), _camera, box, [&](uint32_t tile) { _active[tile] = 1; });
    _changed.clear();
    _phase = Phase::Survey;
}

bool EditScheduler::scout(uint32_t maxPaths, const std::atomic<bool>& cancel) {
    // In the first round each scout stands for as many pixels: only then do shadow rays make a fair sum.
    DiscoveryPasses* passes = discovers(_settings) && _survey.firstRound() ? _passes.get() : nullptr;
    const std::vector<gpu::TileWork>& work = _survey.next(maxPaths);
    const uint32_t paths = _survey.pathCount();
    if (work.empty()) {
        finishSurvey();
        return true;
    }
    const bool done = _tracer.scout(_scene.traversal(), work, paths, cancel, _scoutResults, passes);
    if (passes && done) passes->takeWeights(_weights);
    if (passes && !done) passes->discardWeights();
    if (!done) return false;
    _survey.report(_scoutResults);
    _log.survey(paths);
    return true;
}

void EditScheduler::finishSurvey() {
    if (discovers(_settings)) return startDiscovery();
    std::vector<float> priorities = _survey.priorities();
    for (uint32_t tile = 0; tile < priorities.size();
         ++tile) // elsewhere the view, not the edit, was compared
        if (!_schedule.tiles()[tile].comparable && !_survey.suspected(tile)) priorities[tile] = 0.f;
    order(priorities);
    _radiance = _survey.meanRadiance();
    _moved = false;
    if (_radiance > 0.f) _phase = Phase::Follow;
}

/// Adds what the scouts saw to the active tiles and sends their first samples on their way.
void EditScheduler::startDiscovery() {
    const std::vector<float> changes = _survey.priorities();
    uint32_t count = 0;
    for (uint32_t tile = 0; tile < _active.size(); ++tile) {
        _active[tile] |= changes[tile] > SeedChange * _survey.meanRadiance();
        count += _active[tile];
    }
    // Without active tiles there are no paths to learn from, and when nearly all are, nothing to be learnt.
    if (count == 0 || count > WideEdit * double(_active.size()))
        return order(discoveredPriorities(_weights, _active));
    float first = 0.f; // ahead of what earlier edits have left behind
    for (const TileState& tile : _schedule.tiles())
        first = std::max(first, tile.priority);
    for (uint32_t tile = 0; tile < _active.size(); ++tile)
        if (_active[tile]) _schedule.discover(tile, first + 1.f);
    _schedule.sort(false);
    _log.order(_schedule);
    _passes->setActiveTiles(_active);
    _phase = Phase::Discover;
}

void EditScheduler::traced(bool done) {
    if (_phase == Phase::Follow && _schedule.samplesDone() > 0) _phase = Phase::Idle; // all is measured
    if (_phase != Phase::Discover) return;
    if (!done) return _passes->discardWeights();
    _passes->takeWeights(_weights);
    for (uint32_t tile = 0; tile < _active.size(); ++tile)
        if (_active[tile] && _schedule.tiles()[tile].samples == 0) return;
    order(discoveredPriorities(_weights, _active));
}

float EditScheduler::changeScale() const {
    return _phase == Phase::Follow ? StepsPerRadiance / _radiance : 0.f;
}

/// Where new samples show a change, it goes on next door: tiles around are next.
void EditScheduler::measured(const std::vector<gpu::TileWork>& tiles,
                             const std::vector<gpu::TileChange>& changes) {
    if (_phase != Phase::Follow) return;
    for (size_t i = 0; i < tiles.size(); ++i) {
        if (tiles[i].firstSample > 0) continue;
        const uint32_t tile = _schedule.grid().at(tiles[i].x, tiles[i].y);
        const float steps = float(tiles[i].width * tiles[i].height) * StepsPerRadiance;
        const float noise = float(changes[i].noise) / steps * _radiance;
        if (_moved) {
            _schedule.compared(tile, noise);
            continue;
        }
        if (!_schedule.tiles()[tile].comparable) continue;
        const float change = float(changes[i].change) / steps; // in mean radiances
        _schedule.measured(tile, change * _radiance, noise);
        if (change < LeastChange) continue;
        forNeighbours(_schedule.grid(), tile, [&](uint32_t neighbour) {
            _schedule.discover(neighbour, NeighbourShare * change * _radiance);
        });
    }
}

void EditScheduler::order(const std::vector<float>& priorities) {
    for (uint32_t tile = 0; tile < priorities.size(); ++tile)
        _schedule.discover(tile, priorities[tile]);
    _schedule.sort(false);
    if (_schedule.discoveredTiles() > WideEdit * _schedule.grid().count()) _schedule.sort(true);
    _phase = Phase::Idle;
    _log.order(_schedule);
}

} // namespace hipr
