/// @file schedule.h
/// Which tiles get which samples next.
#pragma once

#include <vector>

#include "renderer/hipr/tile_grid.h"
#include "shaders/shared/trace.h"

namespace hipr {

/// What is known of a tile.
struct TileState {
    uint32_t samples = 0;   ///< of the current scene, in the film; 0: the film shows an older picture there
    uint32_t age = 0;       ///< edits since the picture of the tile was rendered; 0: it is current
    float priority = 0.f;   ///< how much the edit shows, as estimated or measured; 0: not that anybody knows
    uint32_t shown = 0;     ///< samples in the mean on display, of whatever scene; 0: nothing was ever shown
    bool comparable = true; ///< sample 0 of the picture on display is of the view that is rendered
    bool measured = false;  ///< the priority is measured, no estimate
    bool foreseen = false;  ///< was discovered when its first sample was handed out
    float change = 0.f;     ///< of the first samples since the picture on display, edit by edit, summed up
    float noise = 0.f;      ///< how far the last first sample was from the mean on display
    uint32_t wanted = 0;    ///< samples after the pilot, once that is rendered
    bool keepsOld = false;  ///< on display is the older picture, which is the better one so far
};

/// Brings a list of tiles to more and more samples, in order, pass after pass. The first pass takes one
/// sample a pixel, so that a picture is there soon; later passes take as many as a batch has room for, at
/// most doubling what is there. A batch may take the end of a pass and the beginning of the next one.
///
/// With a pilot, samples are counted with those of the pilot, and each tile stops where TileState::wanted
/// says. The first samples after the pilot, which replace it, are as many: nothing gets noisier on display.
class TilePasses {
public:
    void restart(std::vector<uint32_t> tiles, const TileGrid& grid, const std::vector<TileState>& states,
                 uint32_t pilot);

    /// Whether every tile has `samples` samples.
    bool complete(uint32_t samples) const { return _tiles.empty() || _at.done >= samples; }
    uint32_t done() const { return _at.done; } ///< samples every tile of the list has
    const std::vector<uint32_t>& tiles() const { return _tiles; }
    uint64_t pixels() const { return _pixels; }

    /// Begins a batch; what was appended since the last accept() comes again.
    void begin();
    /// Appends the next tiles that want samples, as long as the batch stays within `maxPaths`, but at least
    /// one if the batch is empty. No tile comes twice in a batch. Returns whether that brings all to
    /// `samples` samples.
    bool append(std::vector<gpu::TileWork>& batch, uint32_t& paths, uint32_t maxPaths, uint32_t samples,
                const TileGrid& grid, const std::vector<TileState>& states);
    /// What was appended since begin() is rendered.
    void accept() { _at = _ahead; }

private:
    struct Cursor {
        uint32_t done = 0, level = 1; ///< samples before and after the pass under way
        uint32_t next = 0;            ///< tile of the pass under way
    };
    void startPass(uint32_t maxPaths, uint32_t samples, const TileGrid& grid,
                   const std::vector<TileState>& states);
    uint32_t limit(const TileState& state, uint32_t samples) const;
    uint32_t passEnd(const TileState& state, uint32_t samples) const;

    std::vector<uint32_t> _tiles;
    uint64_t _pixels = 0;
    uint32_t _pilot = 0;
    Cursor _at, _ahead;    ///< behind what is rendered, and behind what is in the batch
    uint32_t _first = 0;   ///< position of the batch's first tile
    bool _any = false;     ///< there is one
    bool _wrapped = false; ///< the batch goes on in the next pass
};

/// The order of all tiles after an edit:
///   1. Discovered tiles (priority above 0) get their first sample, the most important ones leading. A share
///   of the
///      work, the floor, goes to the other tiles meanwhile, so that nothing starves in a stream of edits.
///   2. The other tiles get their first sample, those whose picture is oldest leading. What samples change is
///      measured; tiles in which they do are discovered, and those around them.
///   3. Discovered tiles get the rest of their samples, then all others.
/// Without discovered tiles this is uniform rendering. Small batches cost more a path, so that a batch for
/// which too few discovered tiles are left is filled up with others, but for the first one after an edit.
///
/// A tile of which the edit changes nothing, or less than shows through the noise of the new samples, keeps
/// the picture on display, so that what an edit hardly touches does not turn noisy. At the latest the new
/// samples show when there are as many. Changes are those of first samples, which have the noise of the ones
/// they are compared with; changes of several edits add up until the tile is refreshed.
///
/// Whatever the order, every tile gets its samples 0, 1, 2... once: the picture at N samples does not depend
/// on it.
class TileSchedule {
public:
    /// A picture of another size or other tiles: nothing has been shown yet.
    void reset(const TileGrid& grid);
    /// The scene changed. What the film shows is kept on display, tile by tile, until the first new sample.
    /// Tiles that were discovered but not refreshed stay discovered.
    void invalidate();
    /// Forgets all priorities: the next tiles come in uniform order.
    void forgetPriorities();

    /// Whether old pictures are kept; if not, those that are on display give way to the new samples.
    void keepPictures(bool keep);
    /// The view changed: samples from before cannot be compared with new ones.
    void changeView();
    /// After invalidate(): the picture on display was carried to another camera and is the old picture of all
    /// tiles. `errors`: what became wrong in each tile by that, in radiance; they become the priorities.
    /// `everywhere`: in all tiles alike.
    void carried(const std::vector<float>& errors, float everywhere);
    /// After carried(): how far a tile's first sample is from the mean on display. As measured(), but the
    /// change is as it was estimated.
    void compared(uint32_t tile, float noise);

    /// Adds to what is believed of the edit: a tile that was not measured keeps its greatest priority. Takes
    /// effect with the next sort() or advance().
    void discover(uint32_t tile, float priority);
    /// What is known of a tile: how much its first sample differs from the same sample of the picture on
    /// display, and (`noise`) from the mean on display; both in radiance. Between next() and advance() of the
    /// work that holds it.
    void measured(uint32_t tile, float change, float noise);
    /// Orders the tiles. `everything`: the undiscovered ones go behind the discovered ones in the same list,
    /// because the edit shows nearly everywhere.
    void sort(bool everything);
    /// Adaptive sampling: the first `samples` samples of every tile only tell how many more it wants, and are
    /// not among those that next() and samplesDone() count. 0: none. Takes effect with reset() or
    /// invalidate(), which must follow.
    void setPilot(uint32_t samples) { _pilot = samples; }
    uint32_t pilot() const { return _pilot; }
    /// A tile whose pilot is complete wants that many samples, no less than the pilot has. Between next() and
    /// advance() of the work that completes the pilot.
    void want(uint32_t tile, uint32_t samples) { _states[tile].wanted = std::max(samples, _pilot); }

    /// Share of the work that goes to undiscovered tiles without a new sample, 0..1.
    void setFloor(float share) { _floor = share; }

    /// The next work, of about `maxPaths` paths at most (but at least one tile). Empty when every pixel has
    /// `samples` samples. Work is handed out again until advance() accepts it, so an abandoned batch loses
    /// nothing. Tiles that have an old picture to keep are marked gpu::TILE_SAVES_OLD.
    const std::vector<gpu::TileWork>& next(uint32_t maxPaths, uint32_t samples);
    void advance();

    const TileGrid& grid() const { return _grid; }
    const std::vector<TileState>& tiles() const { return _states; }
    /// Slots the work of the last next() fills.
    uint32_t pathCount() const { return _paths; }
    /// Samples that every pixel has, or, with a pilot, has or does not want; the pilot's own until they are
    /// replaced. Those asked for when all is done.
    uint32_t samplesDone() const;
    /// Samples in the mean of a tile that shows the current scene.
    uint32_t samplesInMean(uint32_t tile) const;
    /// Paths of the current scene in all, as far as it is known what tiles want.
    uint64_t pathsWanted(uint32_t samples) const;
    /// Samples of all pixels of the current scene.
    uint64_t pathsDone() const { return _pathsDone; }
    /// Whether every tile has shown some picture.
    bool everythingShown() const { return _neverShown == 0; }
    /// Whether any tile has.
    bool anythingShown() const { return _neverShown < _grid.count(); }
    /// Whether every discovered tile has a sample of the current scene.
    bool discoveredRefreshed() const { return _front.complete(1); }
    uint32_t discoveredTiles() const { return _discovered; }

private:
    void show(TileState& state);
    void appendFloor(uint32_t maxPaths, uint32_t samples);
    void appendInOrder(uint32_t maxPaths, uint32_t first);
    bool keepsOld(const TileState& state) const;

    TileGrid _grid;
    std::vector<TileState> _states;
    TilePasses _front, _rest;
    float _floor = 0.125f;
    uint32_t _pilot = 0;
    uint32_t _samples = 0; ///< wanted by the last next(), with the pilot
    double _owed = 0;      ///< paths the floor is behind with; below 0: what the discovered tiles have ahead
    uint32_t _neverShown = 0, _discovered = 0;
    bool _everything = false, _unsorted = false, _keepsPictures = true;
    uint64_t _pathsDone = 0;

    std::vector<gpu::TileWork> _work; ///< handed out by next()
    uint32_t _paths = 0;
    double _owedAfter = 0;
};

} // namespace hipr
