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

/// `rows`: grid.tileSize entries a tile.
Staleness staleness(const TileGrid& grid, const std::vector<gpu::CarriedRow>& rows);

} // namespace hipr
