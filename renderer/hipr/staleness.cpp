#include "renderer/hipr/staleness.h"

namespace hipr {
namespace {

/// Least error of a tile that counts, in mean radiances of the picture.
constexpr double LeastError = 0.002;

struct TileSums {
    double uncovered = 0, stale = 0, radiance = 0;
};

std::vector<TileSums> sums(const TileGrid& grid, const std::vector<gpu::CarriedStrip>& strips) {
    std::vector<TileSums> tiles(grid.count());
    const uint32_t perTile = grid.tileSize / gpu::CARRIED_STRIP;
    const gpu::CarriedStrip* strip = strips.data();
    for (uint32_t y = 0; y < grid.height; ++y)
        for (uint32_t column = 0; column < grid.columns; ++column) {
            TileSums& tile = tiles[column + y / grid.tileSize * grid.columns];
            for (uint32_t i = 0; i < perTile; ++i, ++strip) {
                tile.uncovered += strip->uncovered;
                tile.stale += double(strip->stale);
                tile.radiance += double(strip->radiance);
            }
        }
    return tiles;
}

} // namespace

Staleness staleness(const TileGrid& grid, const std::vector<gpu::CarriedStrip>& strips) {
    const std::vector<TileSums> tiles = sums(grid, strips);
    double radiance = 0;
    for (const TileSums& tile : tiles)
        radiance += tile.radiance;
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
