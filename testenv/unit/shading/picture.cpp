#include "testenv/unit/shading/picture.h"

#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace hipr::test {

namespace {

Bytes encode(const std::string& extension, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
             const void* pixels) {
    Bytes bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("x." + extension, &memory);
    if (!output || !output->open("x." + extension, spec) || !output->write_image(type, pixels) ||
        !output->close())
        throw std::runtime_error("cannot encode " + extension + ": " + OIIO::geterror());
    return bytes;
}

} // namespace

AssetReader serve(const Files& files) {
    return [files](const std::string& path) {
        for (const auto& [name, bytes] : files)
            if (name == path) return bytes;
        return Bytes();
    };
}

Bytes encode8(const std::string& extension, int width, int height, int channels,
              const std::vector<uint8_t>& pixels) {
    OIIO::ImageSpec spec(width, height, channels, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    return encode(extension, spec, OIIO::TypeDesc::UINT8, pixels.data());
}

Bytes encodeFloat(const std::string& extension, int width, int height, int channels,
                  const std::vector<float>& pixels, const std::string& wrapModes) {
    OIIO::ImageSpec spec(width, height, channels,
                         extension == "png" ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT);
    if (!wrapModes.empty()) spec["wrapmodes"] = wrapModes;
    return encode(extension, spec, OIIO::TypeDesc::FLOAT, pixels.data());
}

Bytes encodePpm(int width, int height, const std::vector<uint8_t>& rgb) {
    const std::string header = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    Bytes bytes(header.begin(), header.end());
    bytes.insert(bytes.end(), rgb.begin(), rgb.end());
    return bytes;
}

} // namespace hipr::test
