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
    ImageHeader header;  ///< no levels: there is no such file, or it cannot be read
    uint32_t format = 0; ///< expected, by the header
    uint32_t finest = 0; ///< level that is in memory or wanted there; levels finer than that are left out
    bool tried = false;  ///< to load that
    Image image;         ///< texels are dropped after the upload unless they are kept
    Buffer buffer;

    bool exists() const { return !header.levels.empty(); }
    bool loaded() const { return bool(buffer); }
    /// Bytes of the levels from `first` on, coarser ones included.
    uint64_t bytes(uint32_t first) const;
};

struct TextureSource {
    std::string path, colorSpace;
    std::string subject; ///< who asked first, for messages
    uint32_t users = 0;
    DomeFormat format = DomeFormat::LatLong;
    bool ofLight = false;    ///< its finest level alone, whatever the limit
    bool keepPixels = false; ///< of a light's
    bool examined = false;
    std::vector<TextureTile> tiles;

    bool udim() const { return path.find("<UDIM>") != std::string::npos; }
    std::string tilePath(size_t tile) const;
};

/// Reads and uploads texture files on all cores, one picture each at a time. What cannot be read gives one
/// message.
class TextureLoader {
public:
    TextureLoader(Device& device, const AssetReader& assets, const ColorManager& color)
        : _device(device), _assets(assets), _color(color) {}

    /// Finds the tiles of sources and reads their headers.
    void examine(const std::vector<TextureSource*>& sources) const;
    /// Loads the tiles that exist and have not been tried.
    void load(const std::vector<TextureSource*>& sources) const;

private:
    struct Job;
    void run(std::vector<Job>& jobs, void (TextureLoader::*work)(Job&) const) const;
    void examine(Job& job) const;
    void load(Job& job) const;
    void decode(Job& job, ImageFile& file, Image& image) const;

    Device& _device;
    const AssetReader& _assets;
    const ColorManager& _color;
};

} // namespace hipr
