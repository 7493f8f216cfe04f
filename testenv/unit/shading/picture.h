/// @file picture.h
/// Picture files made in memory.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/shading/textures.h"

namespace hipr::test {

using Bytes = std::vector<unsigned char>;

/// Files by path, served by an AssetReader.
using Files = std::vector<std::pair<std::string, Bytes>>;
AssetReader serve(const Files& files);

/// Encodes rows from the top. `extension` is png, exr, tif or hdr; floats are stored as floats by exr, as 16
/// bit by png.
Bytes encode8(const std::string& extension, int width, int height, int channels,
              const std::vector<uint8_t>& pixels);
Bytes encodeFloat(const std::string& extension, int width, int height, int channels,
                  const std::vector<float>& pixels, const std::string& wrapModes = "");
/// A mip-mapped OpenEXR file whose levels show one grey each; the first is `width` x `height`.
Bytes encodeLevels(uint32_t width, uint32_t height, const std::vector<float>& greys);
/// A binary PPM, which needs a file on disk to be read.
Bytes encodePpm(int width, int height, const std::vector<uint8_t>& rgb);

} // namespace hipr::test
