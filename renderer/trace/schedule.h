/// @file schedule.h
/// Which tiles get which samples next.
#pragma once

#include <vector>

#include "shaders/shared/trace.h"

namespace hipr {

/// Gives every pixel the same number of samples: whole passes over the picture, tile after tile. The first
/// pass takes one sample a pixel so that a picture is there soon; small pictures then take several at once.
class UniformSchedule {
public:
    static constexpr uint32_t DefaultTileSize = 16;

    void restart(uint32_t width, uint32_t height, uint32_t tileSize = DefaultTileSize);

    /// The next work, of `maxPaths` paths at most (but at least one tile, whose paths number at most
    /// max(tileSize^2, maxPaths of an earlier call)). Empty when every pixel has `samples` samples. Work is
    /// handed out again until advance() accepts it, so an abandoned batch loses nothing.
    const std::vector<gpu::TileWork>& next(uint32_t maxPaths, uint32_t samples);
    void advance();

    /// Samples that every pixel has.
    uint32_t samplesDone() const { return _passFirst; }
    /// Slots the work of the last next() fills.
    uint32_t pathCount() const { return _pathCount; }

private:
    gpu::TileWork tile(uint32_t index) const;

    uint32_t _width = 0, _height = 0, _tileSize = DefaultTileSize, _columns = 0, _tiles = 0;
    uint32_t _passFirst = 0, _passSamples = 0; ///< samples of the pass under way
    uint32_t _nextTile = 0;                    ///< of the pass under way
    uint32_t _pathCount = 0;
    std::vector<gpu::TileWork> _work;
};

} // namespace hipr
