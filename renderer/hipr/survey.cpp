#include "renderer/hipr/survey.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hipr {
namespace {

constexpr uint32_t Rounds = 2, SpreadRounds = 4; ///< the lattice included
constexpr uint32_t EnoughScouts = 16;            ///< a tile
constexpr uint32_t SuspectLattice = 2;           ///< further scouts a side of a suspected tile
/// Where more of the picture is suspected than this, the lattice finds the edit by itself.
constexpr double ManySuspects = 0.1;
/// The same for suspicion that spreads.
constexpr double WideEdit = 0.4;
/// Brightest change that counts, in mean radiances: one lucky path must not make a tile the most important.
constexpr float BrightestChange = 16.f;
/// Least change of a tile that counts, in mean radiances.
constexpr float LeastChange = 0.002f;

/// Points that fill the unit square evenly in any number: M. Roberts, "The Unreasonable Effectiveness of
/// Quasirandom Sequences", 2018 (R2).
uint32_t spread(uint32_t index, uint32_t axis, uint32_t size) {
    const double step = axis == 0 ? 0.7548776662466927 : 0.5698402909980532;
    const double value = 0.5 + step * index;
    return std::min(size - 1, uint32_t((value - std::floor(value)) * size));
}

uint32_t latticeSize(uint32_t first, uint32_t end, uint32_t stride) {
    return first < end ? (end - first + stride - 1) / stride : 0;
}

} // namespace

void Survey::begin(const TileGrid& grid, float rate, uint32_t turn, bool spread) {
    *this = {};
    _grid = grid;
    _turn = turn;
    _spread = spread;
    _stride = std::max(1u, uint32_t(std::lround(1.0 / std::sqrt(double(rate)))));
    _tiles.resize(grid.count());
}

void Survey::suspect(uint32_t tile) {
    _tiles[tile].suspected = true;
}

void Survey::append(const gpu::TileWork& work) {
    if (work.width && work.height) _planned.push_back(work);
}

/// Rows of the lattice are work items of their own, so that a batch can end between any two.
void Survey::planLattice() {
    const uint32_t x = spread(_turn, 0, _stride), y = spread(_turn, 1, _stride);
    const uint32_t columns = latticeSize(x, _grid.width, _stride),
                   rows = latticeSize(y, _grid.height, _stride);
    for (uint32_t row = 0; row < rows; ++row)
        append({x, y + row * _stride, columns, 1, 0, 1, 0, _stride, 0});
}

/// Tiles in which a change was seen, and those around, become suspects.
void Survey::spreadSuspicion() {
    for (uint32_t index = 0; index < _tiles.size(); ++index) {
        if (!_tiles[index].changed) continue;
        _tiles[index].suspected = true;
        forNeighbours(_grid, index, [&](uint32_t neighbour) { _tiles[neighbour].suspected = true; });
    }
}

void Survey::planSuspects() {
    if (_spread) spreadSuspicion();
    const auto known = std::count_if(_tiles.begin(), _tiles.end(), [this](const Tile& tile) {
        return _spread ? tile.changed > 0 : tile.suspected;
    });
    if (double(known) > (_spread ? WideEdit : ManySuspects) * double(_tiles.size())) return;
    const uint32_t stride = std::max(1u, _grid.tileSize / SuspectLattice);
    const uint32_t turn = _turn + 7 * _round, shiftX = spread(turn, 1, stride),
                   shiftY = spread(turn, 0, stride);
    for (uint32_t index = 0; index < _tiles.size(); ++index) {
        if (!_tiles[index].suspected || _tiles[index].scouts >= EnoughScouts) continue;
        const TileRect r = _grid.rect(index);
        const uint32_t x = r.x + shiftX, y = r.y + shiftY;
        append({x, y, latticeSize(x, r.x + r.width, stride), latticeSize(y, r.y + r.height, stride), 0, 1, 0,
                stride, 0});
    }
}

void Survey::planRound() {
    _planned.clear();
    _next = 0;
    if (_round == 0)
        planLattice();
    else
        planSuspects();
    ++_round;
}

const std::vector<gpu::TileWork>& Survey::next(uint32_t maxPaths) {
    _work.clear();
    _paths = 0;
    while (_next == _planned.size() && _round < (_spread ? SpreadRounds : Rounds))
        planRound();
    for (size_t i = _next; i < _planned.size(); ++i) {
        gpu::TileWork work = _planned[i];
        const uint32_t paths = work.width * work.height;
        if (_paths && _paths + paths > maxPaths) break;
        work.firstSlot = _paths;
        _paths += paths;
        _work.push_back(work);
    }
    return _work;
}

void Survey::report(const std::vector<gpu::ScoutResult>& results) {
    for (const gpu::ScoutResult& result : results) {
        Tile& tile = _tiles[_grid.at(result.pixel & 0xffff, result.pixel >> 16)];
        ++tile.scouts;
        tile.changed += result.change > 0.f;
    }
    _results.insert(_results.end(), results.begin(), results.end());
    _next += _work.size();
    _work.clear();
}

float Survey::meanRadiance() const {
    double sum = 0;
    for (const gpu::ScoutResult& result : _results)
        sum += result.radiance;
    return _results.empty() ? 0.f : float(sum / double(_results.size()));
}

std::vector<float> Survey::priorities() const {
    const float mean = meanRadiance();
    const float brightest = mean > 0 ? BrightestChange * mean : std::numeric_limits<float>::max();
    std::vector<float> sums(_tiles.size());
    for (const gpu::ScoutResult& result : _results)
        sums[_grid.at(result.pixel & 0xffff, result.pixel >> 16)] += std::min(result.change, brightest);

    // The few scouts of a tile are noisy, and changes are wider than tiles: those of its surroundings count
    // too.
    std::vector<float> priorities(_tiles.size());
    for (uint32_t tile = 0; tile < _tiles.size(); ++tile) {
        const uint32_t row = tile / _grid.columns, column = tile % _grid.columns;
        float sum = 4.f * sums[tile], scouts = 4.f * float(_tiles[tile].scouts);
        forNeighbours(_grid, tile, [&](uint32_t n) {
            const float weight = n / _grid.columns == row || n % _grid.columns == column ? 2.f : 1.f;
            sum += weight * sums[n], scouts += weight * float(_tiles[n].scouts);
        });
        const float change = scouts > 0.f ? sum / scouts : 0.f;
        priorities[tile] = change > LeastChange * mean ? change : 0.f;
    }
    return priorities;
}

} // namespace hipr
