#include "renderer/volumes/field_builder.h"

#include <algorithm>
#include <cmath>

namespace hipr {

FieldBuilder::FieldBuilder(std::string name, uint32_t channels, const glm::dmat4x3& latticeToObject)
    : _grid(std::make_shared<FieldGrid>()) {
    _grid->name = std::move(name);
    _grid->channels = channels;
    _grid->latticeToObject = latticeToObject;
}

void FieldBuilder::add(const glm::ivec3& brick, std::vector<float>& values) {
    float largest = 0.f;
    bool uniform = true;
    const uint32_t channels = _grid->channels;
    for (size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i]) || values[i] < 0.f) {
            values[i] = 0.f;
            _repaired = true;
        }
        largest = std::max(largest, values[i]);
        uniform = uniform && values[i] == values[i % channels];
    }
    if (largest == 0.f) return;
    uint32_t place = uint32_t(_grid->brickCount());
    if (uniform) {
        std::array<float, 3> key{};
        std::copy_n(values.begin(), channels, key.begin());
        place = _uniform.try_emplace(key, place).first->second;
    }
    if (place == _grid->brickCount()) _grid->values.insert(_grid->values.end(), values.begin(), values.end());
    _bricks.push_back({brick, place, largest});
}

std::shared_ptr<const FieldGrid> FieldBuilder::finish() {
    if (_bricks.empty()) return _grid;
    glm::ivec3 lo = _bricks[0].brick, hi = lo;
    for (const Placed& placed : _bricks) {
        lo = glm::min(lo, placed.brick);
        hi = glm::max(hi, placed.brick);
    }
    const glm::dvec3 extent = glm::dvec3(hi) - glm::dvec3(lo) + 1.0;
    if (extent.x * extent.y * extent.z > double(MostEntries)) return nullptr;
    _grid->first = lo * FieldGrid::Cells;
    _grid->bricks = glm::uvec3(extent);
    const size_t entries = size_t(_grid->bricks.x) * _grid->bricks.y * _grid->bricks.z;
    _grid->index.assign(entries, FieldGrid::NoBrick);
    _grid->largest.assign(entries, 0.f);
    for (const Placed& placed : _bricks) {
        const glm::uvec3 at(placed.brick - lo);
        const size_t entry = at.x + _grid->bricks.x * (at.y + size_t(_grid->bricks.y) * at.z);
        _grid->index[entry] = placed.values;
        _grid->largest[entry] = placed.largest;
    }
    return _grid;
}

} // namespace hipr
