/// @file tile_aovs.h
/// AOVs that show the schedule.
#pragma once

#include "renderer/api/film.h"
#include "renderer/hipr/schedule.h"

namespace hipr {

/// Whether an AOV shows what is known of tiles: SampleCount, Priority, Age, Discovered.
bool isTileAov(AovKind kind);

/// Writes such an AOV, one word a pixel, rows bottom-up.
void fillTileAov(AovKind kind, const TileSchedule& schedule, uint32_t* dst);

} // namespace hipr
