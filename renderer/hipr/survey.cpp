#include "renderer/hipr/survey.h"

#include <cmath>

namespace hipr {
namespace {

constexpr uint32_t Rounds = 4;        ///< the first included
constexpr uint32_t TileLattice = 2;   ///< scouts a side that a later round adds to a tile
constexpr uint32_t EnoughScouts = 16; ///< a tile
/// Edits that show in more of the picture than this are not looked at more closely.
constexpr double WideEdit = 0.4;
/// Brightest change that counts, in mean radiances: one lucky path must not make a tile the most important.
constexpr float BrightestChange = 16.f;
/// What an unchanged neighbour of a changed tile is taken for, as a share of that tile's change.
constexpr float NeighbourShare = 0.02f;

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

void Survey::begin(const TileGrid& grid, float rate, uint32_t turn) {
    *this = {};
    _grid = grid;
    _turn = turn;
    _stride = std::max(1u, uint32_t(std::lround(1.0 / std::sqrt(double(rate)))));
    _tiles.resize(grid.count());
}

void Survey::suspect(uint32_t tile) {
    _tiles[tile].suspected = true;
}

void Survey::settle(uint32_t tile) {
    _tiles[tile].settled = true;
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
        append({x, y + row * _stride, columns, 1, 0, 1, 0, _stride});
}

bool Survey::wanted(uint32_t index) const {
    const Tile& tile = _tiles[index];
    if (tile.settled || tile.scouts >= EnoughScouts || tile.scouts >= _grid.pixels(index)) return false;
    bool close = tile.suspected || tile.changed;
    forNeighbours(_grid, index, [&](uint32_t neighbour) { close |= _tiles[neighbour].changed > 0; });
    return close;
}

void Survey::planTiles() {
    uint32_t changed = 0;
    for (const Tile& tile : _tiles)
        changed += tile.changed || tile.suspected;
    if (changed > WideEdit * _tiles.size()) return;
    const uint32_t stride = std::max(1u, _grid.tileSize / TileLattice);
    for (uint32_t index = 0; index < _tiles.size(); ++index) {
        if (!wanted(index)) continue;
        const TileRect r = _grid.rect(index);
        const uint32_t x = r.x + spread(_turn + 7 * _round, 0, stride),
                       y = r.y + spread(_turn + 7 * _round, 1, stride);
        append({x, y, latticeSize(x, r.x + r.width, stride), latticeSize(y, r.y + r.height, stride), 0, 1, 0,
                stride});
    }
}

void Survey::planRound() {
    _planned.clear();
    _next = 0;
    if (_round == 0)
        planLattice();
    else
        planTiles();
    ++_round;
}

const std::vector<gpu::TileWork>& Survey::next(uint32_t maxPaths) {
    _work.clear();
    _paths = 0;
    while (_next == _planned.size() && _round < Rounds)
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

std::vector<float> Survey::priorities() const {
    double radiance = 0;
    for (const gpu::ScoutResult& result : _results)
        radiance += result.radiance;
    const float brightest = radiance > 0 ? BrightestChange * float(radiance / double(_results.size()))
                                         : std::numeric_limits<float>::max();
    std::vector<float> sums(_tiles.size());
    for (const gpu::ScoutResult& result : _results)
        sums[_grid.at(result.pixel & 0xffff, result.pixel >> 16)] += std::min(result.change, brightest);

    // Half a tile's own mean, half that of its surroundings: few scouts are noisy.
    std::vector<float> priorities(_tiles.size());
    for (uint32_t tile = 0; tile < _tiles.size(); ++tile) {
        float sum = sums[tile], scouts = float(_tiles[tile].scouts), largest = 0.f;
        const float own = scouts > 0.f ? sum / scouts : 0.f;
        forNeighbours(_grid, tile, [&](uint32_t n) {
            sum += sums[n], scouts += float(_tiles[n].scouts);
            if (_tiles[n].scouts) largest = std::max(largest, sums[n] / float(_tiles[n].scouts));
        });
        priorities[tile] = own > 0.f ? 0.5f * (own + sum / scouts) : NeighbourShare * largest;
    }
    return priorities;
}

} // namespace hipr
