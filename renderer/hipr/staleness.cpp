#include "renderer/hipr/staleness.h"

namespace hipr {
namespace {

/// Least error of a tile that counts, in mean radiances of the picture.
constexpr double LeastError = 0.002;

struct TileSums {
    double uncovered = 0, stale = 0, radiance = 0;
};

TileSums sums(const gpu::CarriedRow* rows, uint32_t count) {
    TileSums s;
    for (uint32_t i = 0; i < count; ++i) {
        s.uncovered += rows[i].uncovered;
        s.stale += double(rows[i].stale);
        s.radiance += double(rows[i].radiance);
    }
    return s;
}

} // namespace

Staleness staleness(const TileGrid& grid, const std::vector<gpu::CarriedRow>& rows) {
    std::vector<TileSums> tiles;
    double radiance = 0;
    for (uint32_t tile = 0; tile < grid.count(); ++tile) {
        tiles.push_back(sums(rows.data() + size_t(tile) * grid.tileSize, grid.tileSize));
        radiance += tiles.back().radiance;
    }
    // Nobody knows what came into sight: of the picture's brightness, or of that of the surroundings, of
    // which the guess was made.
    const double mean = radiance / (double(grid.width) * grid.height);
    Staleness staleness;
    staleness.meanRadiance = float(mean);
    for (uint32_t tile = 0; tile < grid.count(); ++tile) {
        const double pixels = grid.pixels(tile), share = tiles[tile].uncovered / pixels;
        const double error = tiles[tile].stale / pixels + share * (mean + tiles[tile].radiance / pixels);
        staleness.errors.push_back(tiles[tile].uncovered > 0 || error > LeastError * mean ? float(error)
                                                                                          : 0.f);
    }
    return staleness;
}

} // namespace hipr
