/// @file staleness.h
/// After a camera move: how much of each tile's picture is wrong. See docs/hipr.md, "Camera motion".
#pragma once

#include <vector>

#include "renderer/hipr/tile_grid.h"
#include "shaders/shared/reproject.h"

namespace hipr {

/// Of a picture that was carried to another camera.
struct Staleness {
    std::vector<float>
        errors;               ///< by tile, mean radiance that is wrong, as estimated; 0: too little to matter
    float meanRadiance = 0.f; ///< of the picture
};

/// How many strips a picture has: rows padded to whole tiles, row by row. Tiles are multiples of them.
inline uint64_t stripsOf(const TileGrid& grid) {
    return uint64_t(grid.columns) * (grid.tileSize / gpu::CARRIED_STRIP) * grid.height;
}

/// `strips`: stripsOf(grid).
Staleness staleness(const TileGrid& grid, const std::vector<gpu::CarriedStrip>& strips);

} // namespace hipr
