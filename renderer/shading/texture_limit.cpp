#include "renderer/shading/texture_limit.h"

#include <queue>
#include <tuple>

namespace hipr {

namespace {

struct Candidate {
    uint64_t finestBytes;
    size_t order;
    TextureTile* tile;
    uint32_t finest, levels;
    bool operator<(const Candidate& o) const {
        return std::tie(finestBytes, o.order) < std::tie(o.finestBytes, order);
    }
};

uint64_t finestBytes(const TextureTile& tile, uint32_t finest) {
    return levelBytes({levelSizes(tile.header.levels[0])[finest]}, tile.format);
}

} // namespace

TextureFit fitTextures(const std::vector<TextureSource*>& sources, uint64_t limit) {
    TextureFit fit;
    std::priority_queue<Candidate> candidates;
    for (TextureSource* source : sources)
        for (TextureTile& tile : source->tiles) {
            if (!tile.exists()) continue;
            ++fit.pictures;
            fit.wanted += source->ofLight ? finestBytes(tile, 0) : tile.bytes(0);
            tile.finest = 0;
            const uint32_t levels = uint32_t(levelSizes(tile.header.levels[0]).size());
            if (!source->ofLight) candidates.push({finestBytes(tile, 0), fit.pictures, &tile, 0, levels});
        }
    fit.taken = fit.wanted;
    while (fit.taken > limit && !candidates.empty()) {
        Candidate largest = candidates.top();
        candidates.pop();
        if (largest.finest + 1 == largest.levels) continue; // a single texel stays
        fit.taken -= largest.finestBytes;
        fit.reduced += largest.finest == 0;
        largest.tile->finest = ++largest.finest;
        largest.finestBytes = finestBytes(*largest.tile, largest.finest);
        candidates.push(largest);
    }
    return fit;
}

} // namespace hipr
