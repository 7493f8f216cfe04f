#include "renderer/hipr/schedule.h"

#include <numeric>

namespace hipr {
namespace {

/// Work on discovered tiles before the floor sets in, in frames.
constexpr double HeadStart = 0.25;
/// A batch of few discovered tiles is filled up with others to this share of the picture.
constexpr double FilledBatch = 1.0 / 16;
/// A change is seen through noise this many times as strong: it has a shape.
constexpr float ChangeThroughNoise = 4.f;
/// Share of the tiles beyond which a move of the camera shows nearly everywhere.
constexpr double WideChange = 0.5;

} // namespace

void TilePasses::restart(std::vector<uint32_t> tiles, const TileGrid& grid,
                         const std::vector<TileState>& states, uint32_t pilot) {
    *this = {};
    _pilot = pilot;
    _tiles = std::move(tiles);
    _at.done = _tiles.empty() ? 0 : states[_tiles[0]].samples;
    for (uint32_t tile : _tiles) {
        _pixels += grid.pixels(tile);
        _at.done = std::min(_at.done, states[tile].samples);
    }
}

void TilePasses::begin() {
    _ahead = _at;
    _any = _wrapped = false;
}

/// Samples after which a tile rests, as far as is known.
uint32_t TilePasses::limit(const TileState& state, uint32_t samples) const {
    if (_pilot == 0) return samples;
    return state.samples < _pilot ? _pilot : std::min(samples, _pilot + state.wanted);
}

/// Samples a tile has after the pass under way.
uint32_t TilePasses::passEnd(const TileState& state, uint32_t samples) const {
    const bool replacesPilot = _pilot > 0 && state.samples == _pilot;
    return std::min(limit(state, samples), replacesPilot ? std::max(_ahead.level, 2 * _pilot) : _ahead.level);
}

void TilePasses::startPass(uint32_t maxPaths, uint32_t samples, const TileGrid& grid,
                           const std::vector<TileState>& states) {
    uint64_t pixels = _pixels;
    if (_pilot > 0) { // many tiles may rest already
        pixels = 0;
        for (uint32_t tile : _tiles)
            if (states[tile].samples < _pilot || limit(states[tile], samples) > _ahead.done)
                pixels += grid.pixels(tile);
    }
    const uint32_t fitting =
        pixels == 0 ? samples : uint32_t(std::clamp<uint64_t>(maxPaths / pixels, 1, samples));
    const uint32_t added = pixels == 0 ? fitting : std::min(fitting, std::max(1u, _ahead.done));
    _ahead.level = std::min(samples, _ahead.done + added);
}

bool TilePasses::append(std::vector<gpu::TileWork>& batch, uint32_t& paths, uint32_t maxPaths,
                        uint32_t samples, const TileGrid& grid, const std::vector<TileState>& states) {
    while (!_tiles.empty() && _ahead.done < samples) {
        if (_ahead.next == 0) startPass(maxPaths, samples, grid, states);
        for (; _ahead.next < _tiles.size(); ++_ahead.next) {
            if (_wrapped && _ahead.next == _first) return false; // from here on they are in the batch
            const uint32_t tile = _tiles[_ahead.next], has = states[tile].samples;
            const uint32_t end = passEnd(states[tile], samples);
            if (has >= end) continue;
            const TileRect r = grid.rect(tile);
            const uint32_t count = end - has, added = r.width * r.height * count;
            if (!batch.empty() && paths + added > maxPaths) return false;
            if (!_any) _first = _ahead.next;
            _any = true;
            batch.push_back({r.x, r.y, r.width, r.height, has, count, paths, 1, 0});
            paths += added;
        }
        _ahead.done = _ahead.level;
        _ahead.next = 0;
        _wrapped = _any;
    }
    return true;
}

void TileSchedule::reset(const TileGrid& grid) {
    const bool keepsPictures = _keepsPictures;
    const uint32_t pilot = _pilot;
    *this = {};
    _keepsPictures = keepsPictures;
    _pilot = pilot;
    _grid = grid;
    _states.assign(grid.count(), {});
    _neverShown = grid.count();
    sort(false);
}

void TileSchedule::invalidate() {
    // A head start for the edit, but only where everything else is up to date: in a stream of edits the floor
    // keeps its claims from one to the next.
    const bool settled =
        std::all_of(_states.begin(), _states.end(), [](const TileState& state) { return state.samples > 0; });
    if (settled) _owed = -double(_floor) * HeadStart * _grid.width * _grid.height;
    for (TileState& state : _states) {
        if (state.samples > 0) state.priority = 0.f; // what it was discovered for is rendered
        state.samples = 0;
        state.measured = false;
        ++state.age;
    }
    _pathsDone = 0;
    sort(false);
}

void TileSchedule::forgetPriorities() {
    for (TileState& state : _states)
        state.priority = 0.f;
    sort(false);
}

void TileSchedule::keepPictures(bool keep) {
    _keepsPictures = keep;
    if (keep) return;
    for (TileState& state : _states) {
        if (!state.keepsOld) continue;
        state.keepsOld = false;
        state.shown = std::max(1u, state.samples); // of this scene or the one before
    }
}

void TileSchedule::changeView() {
    for (TileState& state : _states)
        state.comparable = false;
}

void TileSchedule::carried(const std::vector<float>& errors, float everywhere) {
    for (uint32_t tile = 0; tile < _states.size(); ++tile) {
        TileState& state = _states[tile];
        state.change = (state.keepsOld ? state.change : 0.f) + errors[tile] + everywhere;
        state.keepsOld = true; // the film has what was there before
        discover(tile, errors[tile]);
    }
    sort(false);
    if (_discovered > WideChange * double(_grid.count())) sort(true);
}

void TileSchedule::discover(uint32_t tile, float priority) {
    if (_states[tile].measured || !(priority > _states[tile].priority)) return;
    _states[tile].priority = priority;
    _unsorted = true;
}

void TileSchedule::sort(bool everything) {
    _everything = everything;
    _unsorted = false;
    std::vector<uint32_t> front, rest;
    for (uint32_t tile = 0; tile < _states.size(); ++tile)
        (_states[tile].priority > 0.f ? front : rest).push_back(tile);
    _discovered = uint32_t(front.size());
    // Stable: equal tiles keep the order of the picture, in which neighbours share cache lines.
    std::stable_sort(front.begin(), front.end(),
                     [&](uint32_t a, uint32_t b) { return _states[a].priority > _states[b].priority; });
    std::stable_sort(rest.begin(), rest.end(), [&](uint32_t a, uint32_t b) {
        const TileState &s = _states[a], &t = _states[b];
        return (s.shown > 0) != (t.shown > 0) ? t.shown > 0 : s.age > t.age;
    });
    if (everything && !front.empty()) {
        front.insert(front.end(), rest.begin(), rest.end());
        rest.clear();
    }
    _front.restart(std::move(front), _grid, _states, _pilot);
    _rest.restart(std::move(rest), _grid, _states, _pilot);
}

void TileSchedule::measured(uint32_t tile, float change, float noise) {
    TileState& state = _states[tile];
    _unsorted |= (change > 0.f) != (state.priority > 0.f);
    state.priority = change;
    state.measured = true;
    state.change += change;
    state.noise = noise;
}

void TileSchedule::compared(uint32_t tile, float noise) {
    _states[tile].measured = true;
    _states[tile].noise = noise;
}

/// Whether the old mean is nearer to the truth than that of the new samples, as far as is known: the noise
/// of a mean falls with the root of its samples, the old one is besides wrong by the change.
bool TileSchedule::keepsOld(const TileState& state) const {
    const bool complete = _pilot > 0 && state.samples >= _pilot && state.samples >= _pilot + state.wanted;
    if (!state.measured || complete || state.samples >= std::min(state.shown, _samples)) return false;
    const float change = ChangeThroughNoise * state.change, variance = state.noise * state.noise;
    return variance / float(state.samples) > change * change + variance / float(state.shown);
}

const std::vector<gpu::TileWork>& TileSchedule::next(uint32_t maxPaths, uint32_t samples) {
    _work.clear();
    _paths = 0;
    _front.begin();
    _rest.begin();
    _owedAfter = _owed;
    _samples = samples + _pilot;
    const uint32_t first = std::min(1u, samples);
    if (!_front.complete(first)) appendFloor(maxPaths, first);
    appendInOrder(maxPaths, first);
    if (_work.empty()) { // the passes that are left have nothing to do
        _front.accept();
        _rest.accept();
    }
    for (gpu::TileWork& work : _work) {
        TileState& state = _states[_grid.at(work.x, work.y)];
        if (work.firstSample == 0) state.foreseen = state.priority > 0.f;
        // What is on display already is an older picture yet: that stays the one to keep.
        if (_keepsPictures && work.firstSample == 0 && state.shown > 1)
            work.flags = state.keepsOld ? gpu::TILE_KEEPS_OLD : gpu::TILE_SAVES_OLD;
    }
    return _work;
}

/// One list after the other. What an edit changed does not wait for the other tiles in its first batch, and
/// not for many later; nor does the first picture wait for samples beyond it.
void TileSchedule::appendInOrder(uint32_t maxPaths, uint32_t first) {
    const auto all = [&](TilePasses& passes, uint32_t samples, uint32_t limit) {
        return passes.append(_work, _paths, limit, samples, _grid, _states);
    };
    if (!all(_front, first, maxPaths)) return;
    if (!_work.empty()) {
        const double enough = FilledBatch * _grid.width * _grid.height;
        if (_pathsDone > 0) all(_rest, first, uint32_t(std::min(double(maxPaths), enough)));
        return;
    }
    all(_rest, first, maxPaths);
    if (!_work.empty()) return;
    if (all(_front, _samples, maxPaths)) all(_rest, _samples, maxPaths);
}

/// The floor's tiles lead the batch, so that it has room for them.
void TileSchedule::appendFloor(uint32_t maxPaths, uint32_t samples) {
    if (_rest.complete(1)) return;
    // A share of what is rendered, not of what the batch could hold: few discovered tiles make a small batch.
    _owedAfter += double(_floor) * double(std::min<uint64_t>(maxPaths, _front.pixels()));
    if (_owedAfter < _grid.tileSize * _grid.tileSize) return;
    _rest.append(_work, _paths, std::min(maxPaths, uint32_t(_owedAfter)), samples, _grid, _states);
    _owedAfter -= _paths;
}

/// The new samples are on display.
void TileSchedule::show(TileState& state) {
    state.keepsOld = false;
    state.change = 0.f;
    _neverShown -= state.shown ? 0 : 1;
    state.shown = state.samples;
    state.age = 0;
}

void TileSchedule::advance() {
    for (const gpu::TileWork& work : _work) {
        TileState& state = _states[_grid.at(work.x, work.y)];
        state.samples = work.firstSample + work.sampleCount;
        state.comparable = true;
        state.keepsOld = keepsOld(state);
        if (!state.keepsOld) show(state);
    }
    _pathsDone += _paths;
    _front.accept();
    _rest.accept();
    _owed = _owedAfter;
    if (_unsorted) sort(_everything);
}

uint32_t TileSchedule::samplesDone() const {
    uint32_t done = std::min(_front.done(), _rest.done());
    if (_front.tiles().empty()) done = _rest.done();
    if (_rest.tiles().empty()) done = _front.done();
    return done > _pilot ? done - _pilot : done;
}

uint32_t TileSchedule::samplesInMean(uint32_t tile) const {
    const uint32_t samples = _states[tile].samples;
    return samples > _pilot ? samples - _pilot : samples;
}

uint64_t TileSchedule::pathsWanted(uint32_t samples) const {
    if (_pilot == 0) return uint64_t(_grid.width) * _grid.height * samples;
    uint64_t paths = 0;
    for (uint32_t tile = 0; tile < _states.size(); ++tile) {
        const bool known = _states[tile].samples >= _pilot;
        paths += uint64_t(grid().pixels(tile)) *
                 (_pilot + (known ? std::min(samples, _states[tile].wanted) : samples));
    }
    return paths;
}

} // namespace hipr
