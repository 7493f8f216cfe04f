/// @file tile_grid.h
/// The picture as a grid of square tiles: the unit in which HiPR decides what is refreshed first.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hipr {

struct TileRect {
    uint32_t x, y, width, height; ///< pixels, clipped to the picture
};

struct TileGrid {
    uint32_t width = 0, height = 0; ///< of the picture
    uint32_t tileSize = 16, columns = 0, rows = 0;

    TileGrid() = default;
    TileGrid(uint32_t pictureWidth, uint32_t pictureHeight, uint32_t size)
        : width(pictureWidth), height(pictureHeight), tileSize(size),
          columns((pictureWidth + size - 1) / size), rows((pictureHeight + size - 1) / size) {}

    uint32_t count() const { return columns * rows; }
    /// The tile that holds a pixel.
    uint32_t at(uint32_t x, uint32_t y) const { return x / tileSize + y / tileSize * columns; }
    TileRect rect(uint32_t tile) const {
        const uint32_t x = tile % columns * tileSize, y = tile / columns * tileSize;
        return {x, y, std::min(tileSize, width - x), std::min(tileSize, height - y)};
    }
    uint32_t pixels(uint32_t tile) const {
        const TileRect r = rect(tile);
        return r.width * r.height;
    }
    bool operator==(const TileGrid& o) const {
        return width == o.width && height == o.height && tileSize == o.tileSize;
    }
};

/// Calls `visit` for the up to eight tiles around `tile`.
template <class Visitor> void forNeighbours(const TileGrid& grid, uint32_t tile, Visitor&& visit) {
    const uint32_t column = tile % grid.columns, row = tile / grid.columns;
    for (uint32_t y = row ? row - 1 : 0; y <= std::min(row + 1, grid.rows - 1); ++y)
        for (uint32_t x = column ? column - 1 : 0; x <= std::min(column + 1, grid.columns - 1); ++x)
            if (x != column || y != row) visit(x + y * grid.columns);
}

/// Tiles of 8, 16 or 32 pixels a side, the smallest that keep the grid below some ten thousand: small tiles
/// follow an edit's outline closely, but every tile costs some work of the schedule. All three divide HiGS's
/// macro-tiles of 64 x 32 pixels.
inline uint32_t automaticTileSize(uint32_t width, uint32_t height) {
    constexpr uint64_t ManyTiles = 10000;
    for (uint32_t size : {8u, 16u})
        if (TileGrid(width, height, size).count() <= ManyTiles) return size;
    return 32;
}

} // namespace hipr
