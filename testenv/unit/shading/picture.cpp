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

Bytes encodeLevels(uint32_t width, uint32_t height, const std::vector<float>& greys) {
    Bytes bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto output = OIIO::ImageOutput::create("x.exr", &memory);
    OIIO::ImageSpec spec(0, 0, 3, OIIO::TypeDesc::HALF);
    spec.tile_width = spec.tile_height = 16;
    spec["textureformat"] = "Plain Texture";
    std::vector<LevelSize> sizes = levelSizes({width, height});
    sizes.resize(greys.size());
    for (size_t i = 0; i < sizes.size(); ++i) {
        spec.width = spec.full_width = int(sizes[i].width);
        spec.height = spec.full_height = int(sizes[i].height);
        const std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) * 3, greys[i]);
        const auto mode = i == 0 ? OIIO::ImageOutput::Create : OIIO::ImageOutput::AppendMIPLevel;
        if (!output->open("x.exr", spec, mode) || !output->write_image(OIIO::TypeDesc::FLOAT, pixels.data()))
            throw std::runtime_error("cannot encode levels: " + output->geterror());
    }
    output->close();
    return bytes;
}

Bytes encodePpm(int width, int height, const std::vector<uint8_t>& rgb) {
    const std::string header = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
    Bytes bytes(header.begin(), header.end());
    bytes.insert(bytes.end(), rgb.begin(), rgb.end());
    return bytes;
}

} // namespace hipr::test
