/// @file texture_source.h
/// The texels of one file, or of the tiles of one UDIM set.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/api/light.h"
#include "renderer/shading/image.h"
#include "renderer/vulkan/device.h"

namespace hipr {

/// A tile, or the whole of an ordinary texture.
struct TextureTile {
    Image image; ///< texels are dropped after the upload unless they are kept
    Buffer buffer;
    bool loaded() const { return bool(buffer); }
};

struct TextureSource {
    std::string path, colorSpace;
    std::string subject; ///< who asked first, for messages
    uint32_t users = 0;
    DomeFormat format = DomeFormat::LatLong;
    bool keepPixels = false;
    bool loaded = false; ///< loading was tried
    std::vector<TextureTile> tiles;

    bool udim() const { return path.find("<UDIM>") != std::string::npos; }
    std::string tilePath(size_t tile) const;
};

/// Reads and uploads sources: decoding on all cores, a bounded number of pictures at a time. Each source that
/// cannot be read gives one message.
void loadTextureSources(const std::vector<TextureSource*>& sources, Device& device, const AssetReader& assets,
                        const ColorManager& color);

} // namespace hipr
