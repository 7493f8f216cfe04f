/// @file texture_levels.h
/// Levels of detail of a texture: each half as large as the one before, down to a single texel.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace hipr {

struct LevelSize {
    uint32_t width = 0, height = 0;
    bool operator==(const LevelSize& o) const { return width == o.width && height == o.height; }
};

/// The next coarser level: halves, rounded down, at least 1.
LevelSize coarserLevel(LevelSize size);

/// `finest` and all coarser levels.
std::vector<LevelSize> levelSizes(LevelSize finest);

/// Bytes of levels in a format (gpu::TEXEL_*), one after the other.
uint64_t levelBytes(const std::vector<LevelSize>& levels, uint32_t format);

/// Makes coarser levels out of a level's rows, which are needed only one at a time.
///
/// A texel is the mean of what it covers of the level it was made from, in linear light and without rounding
/// between levels: no width or height is better than another. `weighted`: colours count by their alpha, so
/// that what a mask hides does not show at its edge.
class LevelBuilder {
public:
    /// `texels` gets levels `first`, `first` + 1 and so on, of which level 0 is what the rows are of; sized
    /// by levelBytes(). Rows of a level start at the bottom.
    LevelBuilder(LevelSize size, uint32_t format, bool weighted, uint32_t first, unsigned char* texels);

    /// The next row, from the top.
    void addRow(const unsigned char* texels);

private:
    struct Level {
        LevelSize size;
        unsigned char* texels = nullptr; ///< where it is kept, or null
        uint32_t rows = 0;               ///< came in: of the finer level, but for level 0
        std::vector<glm::vec4> narrow;   ///< one of them, as wide as this level
        std::vector<glm::vec4> sum;      ///< of them, weighted; of the level's next row
    };
    void addRow(size_t level, const std::vector<glm::vec4>& row);
    void finishRow(size_t level, uint32_t row);

    uint32_t _format;
    bool _weighted;
    std::vector<Level> _levels;
    std::vector<glm::vec4> _values, _row; ///< of the row that came, of the row that goes
};

} // namespace hipr
