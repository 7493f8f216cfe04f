#include "renderer/trace/schedule.h"

#include <algorithm>

namespace hipr {

void UniformSchedule::restart(uint32_t width, uint32_t height, uint32_t tileSize) {
    *this = {};
    _width = width;
    _height = height;
    _tileSize = tileSize;
    _columns = (width + tileSize - 1) / tileSize;
    _tiles = _columns * ((height + tileSize - 1) / tileSize);
}

gpu::TileWork UniformSchedule::tile(uint32_t index) const {
    const uint32_t x = index % _columns * _tileSize, y = index / _columns * _tileSize;
    return {x, y, std::min(_tileSize, _width - x), std::min(_tileSize, _height - y), _passFirst, _passSamples,
            0, 0};
}

const std::vector<gpu::TileWork>& UniformSchedule::next(uint32_t maxPaths, uint32_t samples) {
    _work.clear();
    _pathCount = 0;
    if (_passFirst >= samples || _tiles == 0) return _work;
    if (_nextTile == 0) {
        const uint64_t pixels = uint64_t(_width) * _height;
        const uint32_t fitting = uint32_t(std::max<uint64_t>(1, maxPaths / pixels));
        _passSamples = std::min({fitting, std::max(1u, _passFirst), samples - _passFirst});
    }
    for (uint32_t i = _nextTile; i < _tiles; ++i) {
        gpu::TileWork work = tile(i);
        const uint32_t paths = work.width * work.height * work.sampleCount;
        if (!_work.empty() && _pathCount + paths > maxPaths) break;
        work.firstSlot = _pathCount;
        _pathCount += paths;
        _work.push_back(work);
    }
    return _work;
}

void UniformSchedule::advance() {
    _nextTile += uint32_t(_work.size());
    _work.clear();
    if (_nextTile < _tiles) return;
    _nextTile = 0;
    _passFirst += _passSamples;
}

} // namespace hipr
