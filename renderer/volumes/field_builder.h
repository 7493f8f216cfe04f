/// @file field_builder.h
/// Values on a lattice -> the bricks of a FieldGrid.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/api/volume.h"

namespace hipr {

/// Gathers bricks in any order. Bricks in which all values are equal share their storage.
class FieldBuilder {
public:
    FieldBuilder(std::string name, uint32_t channels, const glm::dmat4x3& latticeToObject);

    /// Adds the brick whose first point is FieldGrid::Cells * `brick`, once. `values`: FieldGrid::BrickPoints
    /// times the channels. Values that are not finite or below 0 become 0; a brick in which all are 0 is left
    /// out.
    void add(const glm::ivec3& brick, std::vector<float>& values);

    /// Whether add() had to change values.
    bool repaired() const { return _repaired; }

    /// The grid; null if its bricks lie so far apart that their table would be larger than MostEntries.
    std::shared_ptr<const FieldGrid> finish();

    static constexpr uint64_t MostEntries = 1u << 26;

private:
    struct Placed {
        glm::ivec3 brick;
        uint32_t values;
        float largest;
    };

    std::shared_ptr<FieldGrid> _grid;
    std::vector<Placed> _bricks;
    std::map<std::array<float, 3>, uint32_t> _uniform; ///< bricks of one value
    bool _repaired = false;
};

} // namespace hipr
