#include "renderer/hipr/schedule.h"

#include <numeric>

namespace hipr {
namespace {

/// Work on discovered tiles before the floor sets in, in frames.
constexpr double HeadStart = 0.25;

} // namespace

void TilePasses::restart(std::vector<uint32_t> tiles, const TileGrid& grid,
                         const std::vector<TileState>& states) {
    *this = {};
    _tiles = std::move(tiles);
    _done = _tiles.empty() ? 0 : states[_tiles[0]].samples;
    for (uint32_t tile : _tiles) {
        _pixels += grid.pixels(tile);
        _done = std::min(_done, states[tile].samples);
    }
}

uint32_t TilePasses::append(std::vector<gpu::TileWork>& batch, uint32_t& paths, uint32_t maxPaths,
                            uint32_t samples, const TileGrid& grid, const std::vector<TileState>& states) {
    const size_t before = batch.size();
    while (!complete(samples)) {
        if (_next == 0) {
            const uint32_t fitting = uint32_t(std::max<uint64_t>(1, maxPaths / _pixels));
            _level = std::min(samples, _done + std::min(fitting, std::max(1u, _done)));
        }
        uint32_t taken = 0;
        for (uint32_t i = _next; i < _tiles.size(); ++i, ++taken) {
            const TileState& state = states[_tiles[i]];
            if (state.samples >= _level) continue;
            const TileRect r = grid.rect(_tiles[i]);
            const uint32_t count = _level - state.samples, added = r.width * r.height * count;
            if (!batch.empty() && paths + added > maxPaths) break;
            batch.push_back({r.x, r.y, r.width, r.height, state.samples, count, paths, 1});
            paths += added;
        }
        if (batch.size() > before || _next + taken < _tiles.size()) return taken;
        advance(taken); // nobody wants samples of what is left of this pass
    }
    return 0;
}

void TilePasses::advance(uint32_t tiles) {
    _next += tiles;
    if (_next < _tiles.size() || _tiles.empty()) return;
    _next = 0;
    _done = _level;
}

void TileSchedule::reset(const TileGrid& grid) {
    *this = {};
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
        if (state.samples > 0) state.priority = 0.f; // what it was discovered for is shown
        state.samples = 0;
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

void TileSchedule::discover(uint32_t tile, float priority) {
    _states[tile].priority = std::max(_states[tile].priority, priority);
}

void TileSchedule::sort(bool everything) {
    std::vector<uint32_t> front, rest;
    for (uint32_t tile = 0; tile < _states.size(); ++tile)
        (_states[tile].priority > 0.f ? front : rest).push_back(tile);
    _discovered = uint32_t(front.size());
    // Stable: equal tiles keep the order of the picture, in which neighbours share cache lines.
    std::stable_sort(front.begin(), front.end(),
                     [&](uint32_t a, uint32_t b) { return _states[a].priority > _states[b].priority; });
    std::stable_sort(rest.begin(), rest.end(), [&](uint32_t a, uint32_t b) {
        const TileState &s = _states[a], &t = _states[b];
        return s.everShown != t.everShown ? t.everShown : s.age > t.age;
    });
    if (everything && !front.empty()) {
        front.insert(front.end(), rest.begin(), rest.end());
        rest.clear();
    }
    _front.restart(std::move(front), _grid, _states);
    _rest.restart(std::move(rest), _grid, _states);
}

const std::vector<gpu::TileWork>& TileSchedule::next(uint32_t maxPaths, uint32_t samples) {
    _work.clear();
    _paths = _frontTaken = _restTaken = 0;
    _owedAfter = _owed;
    const bool frontOpen = !_front.complete(samples);
    if (frontOpen) {
        const bool starving = !_rest.tiles().empty() && _rest.firstPass();
        if (starving) _owedAfter += double(_floor) * maxPaths;
        // The floor's tiles lead, so that the batch has room for them.
        const uint32_t tilePaths = _grid.tileSize * _grid.tileSize;
        if (starving && _owedAfter >= tilePaths) {
            _restTaken =
                _rest.append(_work, _paths, std::min(maxPaths, uint32_t(_owedAfter)), 1, _grid, _states);
            _owedAfter -= _paths;
        }
        _frontTaken = _front.append(_work, _paths, maxPaths, samples, _grid, _states);
    } else {
        _restTaken = _rest.append(_work, _paths, maxPaths, samples, _grid, _states);
    }
    return _work;
}

void TileSchedule::advance() {
    for (const gpu::TileWork& work : _work) {
        TileState& state = _states[_grid.at(work.x, work.y)];
        _neverShown -= state.everShown ? 0 : 1;
        state.everShown = true;
        state.samples = work.firstSample + work.sampleCount;
        state.age = 0;
    }
    _pathsDone += _paths;
    _front.advance(_frontTaken);
    _rest.advance(_restTaken);
    _owed = _owedAfter;
    _work.clear();
}

uint32_t TileSchedule::samplesDone() const {
    if (_front.tiles().empty()) return _rest.done();
    return _rest.tiles().empty() ? _front.done() : std::min(_front.done(), _rest.done());
}

} // namespace hipr
