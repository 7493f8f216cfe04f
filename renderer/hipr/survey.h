/// @file survey.h
/// Where does an edit show? Delta mode's answer, from a few scout paths.
///
/// A scout is sample 0 of a pixel, rendered in the edited scene. The same sample, in the picture on display,
/// was kept when it was rendered (gpu::TraceRecord::firstSamples). Both use the same random numbers, so a
/// path the edit does not touch brings the very same light, to the last bit, and the difference is exactly
/// zero: what is not zero shows the edit, whether directly, in a mirror, by its shadow or through glass. The
/// mean difference of a tile's scouts estimates how much. No second scene has to be kept, and where several
/// edits follow each other the comparison is with what the user sees.
#pragma once

#include <vector>

#include "renderer/hipr/tile_grid.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// Plans scouts in rounds: first a sparse lattice over the whole picture, then more of them where the edit
/// was seen, around that, and where changed objects are known to be. Used by one thread.
class Survey {
public:
    /// `rate`: share of the picture's pixels in the first round. `turn` (say, the number of the edit) chooses
    /// which pixels, so that a stream of edits looks at all of them in time. `spread`: also look closely at
    /// tiles in and around which a change was seen; who measures what he renders has no need to.
    void begin(const TileGrid& grid, float rate, uint32_t turn, bool spread = false);
    /// A tile in which something that changed is or was; looked at closely. Between begin() and next().
    void suspect(uint32_t tile);
    bool suspected(uint32_t tile) const { return _tiles[tile].suspected; }

    /// The next scouts, about `maxPaths` of them at most. Empty when the survey is complete. Handed out again
    /// until report() brings their results, one a path, in the order of the slots.
    const std::vector<gpu::TileWork>& next(uint32_t maxPaths);
    void report(const std::vector<gpu::ScoutResult>& results);
    /// Paths of the last next().
    uint32_t pathCount() const { return _paths; }
    /// Paths reported so far.
    uint64_t pathsTraced() const { return _results.size(); }

    /// Whether the next scouts are of the first round, one for every 1 / rate pixels.
    bool firstRound() const { return _round == 0 || (_round == 1 && _next < _planned.size()); }
    float pixelsPerScout() const { return float(_stride * _stride); }

    /// How much the edit shows in each tile, 0: not at all as far as is known. The unit is radiance.
    std::vector<float> priorities() const;
    /// Mean over the scouts and channels, of the edited scene.
    float meanRadiance() const;

private:
    struct Tile {
        uint32_t scouts = 0, changed = 0;
        bool suspected = false;
    };
    void planRound();
    void planLattice();
    void spreadSuspicion();
    void planSuspects();
    void append(const gpu::TileWork& work);

    TileGrid _grid;
    bool _spread = false;
    uint32_t _stride = 8, _turn = 0, _round = 0;
    std::vector<Tile> _tiles;
    std::vector<gpu::TileWork> _planned; ///< of the round under way
    size_t _next = 0;                    ///< of _planned
    std::vector<gpu::TileWork> _work;
    uint32_t _paths = 0;
    std::vector<gpu::ScoutResult> _results;
};

} // namespace hipr
