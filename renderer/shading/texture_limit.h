/// @file texture_limit.h
/// Which levels of which textures are left out so that all fit a limit.
#pragma once

#include <vector>

#include "renderer/shading/texture_source.h"

namespace hipr {

/// What became of a limit.
struct TextureFit {
    uint64_t wanted = 0; ///< bytes of all textures in full
    uint64_t taken = 0;  ///< at most, with what is left
    size_t reduced = 0;  ///< pictures of which levels are left out
    size_t pictures = 0;
};

/// Sets TextureTile::finest of all tiles that exist: while all take more than `limit` bytes, the picture
/// whose finest level is largest goes without it, the first of several. Depends on nothing but the pictures
/// and their order. What lights show stays whole, though it counts.
TextureFit fitTextures(const std::vector<TextureSource*>& sources, uint64_t limit);

} // namespace hipr
