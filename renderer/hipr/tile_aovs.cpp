#include "renderer/hipr/tile_aovs.h"

#include <cstring>

namespace hipr {
namespace {

uint32_t wordOf(AovKind kind, const TileSchedule& schedule, uint32_t index) {
    const TileState& tile = schedule.tiles()[index];
    uint32_t word = 0;
    switch (kind) {
    case AovKind::SampleCount:
        return tile.keepsOld ? 0 : schedule.samplesInMean(index);
    case AovKind::Age:
        return tile.shown ? tile.age : uint32_t(-1);
    case AovKind::Discovered:
        return tile.priority > 0.f ? 1 : 0;
    case AovKind::Priority:
        std::memcpy(&word, &tile.priority, sizeof(word));
        return word;
    default:
        return word;
    }
}

} // namespace

bool isTileAov(AovKind kind) {
    return kind == AovKind::SampleCount || kind == AovKind::Priority || kind == AovKind::Age ||
           kind == AovKind::Discovered;
}

void fillTileAov(AovKind kind, const TileSchedule& schedule, uint32_t* dst) {
    const TileGrid& grid = schedule.grid();
    for (uint32_t tile = 0; tile < grid.count(); ++tile) {
        const TileRect r = grid.rect(tile);
        const uint32_t word = wordOf(kind, schedule, tile);
        for (uint32_t y = r.y; y < r.y + r.height; ++y)
            std::fill_n(dst + size_t(y) * grid.width + r.x, r.width, word);
    }
}

} // namespace hipr
