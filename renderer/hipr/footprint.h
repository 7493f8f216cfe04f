/// @file footprint.h
/// The tiles in which a part of the world may be seen.
#pragma once

#include <cmath>

#include "renderer/hipr/tile_grid.h"
#include "renderer/scene/world_box.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// Calls `visit` for every tile that a camera could see the box in. A box that reaches behind the camera may
/// be anywhere: all tiles.
template <class Visitor>
void forTilesSeeing(const TileGrid& grid, const gpu::CameraRecord& camera, const WorldBox& box,
                    Visitor&& visit) {
    if (box.empty() || grid.count() == 0) return;
    glm::vec2 lo(1.f), hi(-1.f);
    bool first = true, behind = false;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                          corner & 4 ? box.max.z : box.min.z);
        const glm::vec4 clip = camera.worldToClip * glm::vec4(p, 1.f);
        if (!(clip.w > 0.f)) {
            behind = true;
            break;
        }
        const glm::vec2 ndc(clip.x / clip.w, clip.y / clip.w);
        lo = first ? ndc : glm::min(lo, ndc);
        hi = first ? ndc : glm::max(hi, ndc);
        first = false;
    }
    if (behind) lo = glm::vec2(-1.f), hi = glm::vec2(1.f);
    if (!(lo.x < 1.f && lo.y < 1.f && hi.x > -1.f && hi.y > -1.f)) return;
    // A pixel more on each side: filters reach beyond their pixel.
    const auto tile = [&](float ndc, uint32_t size, float margin) {
        const float pixel = (0.5f * glm::clamp(ndc, -1.f, 1.f) + 0.5f) * float(size) + margin;
        return uint32_t(glm::clamp(pixel, 0.f, float(size - 1))) / grid.tileSize;
    };
    const uint32_t x0 = tile(lo.x, grid.width, -1.f), x1 = tile(hi.x, grid.width, 1.f);
    const uint32_t y0 = tile(lo.y, grid.height, -1.f), y1 = tile(hi.y, grid.height, 1.f);
    for (uint32_t y = y0; y <= y1; ++y)
        for (uint32_t x = x0; x <= x1; ++x)
            visit(x + y * grid.columns);
}

} // namespace hipr
