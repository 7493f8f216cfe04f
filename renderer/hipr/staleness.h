/// @file staleness.h
/// After a camera move: how much of each tile's picture is wrong. See docs/hipr.md, "Camera motion".
#pragma once

#include <vector>

#include "renderer/hipr/tile_grid.h"
#include "shaders/shared/reproject.h"

namespace hipr {

/// By tile, the mean error of the picture that was carried to another camera, as estimated; the unit is
/// radiance. 0 where it is too small to matter. `rows`: grid.tileSize entries a tile.
std::vector<float> staleRadiance(const TileGrid& grid, const std::vector<gpu::CarriedRow>& rows);

} // namespace hipr
