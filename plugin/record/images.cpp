#include "plugin/record/images.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

#include "plugin/record/aovLayers.h"
#include "plugin/record/cryptomatte.h"
#include "plugin/record/failure.h"

namespace fs = std::filesystem;

namespace hipr::record {

namespace {

/// A hidden file beside the final one, so that the rename stays on one file system.
fs::path temporaryPath(const fs::path& path) {
    return path.parent_path() /
           ("." + path.stem().string() + "." + std::to_string(getpid()) + path.extension().string());
}

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw Failure(ExitOutput, "cannot write '" + path + "': " + why);
}

OIIO::TypeDesc channelType(const Layer& layer) {
    if (layer.integer) return OIIO::TypeUInt;
    return layer.half && isColour(layer.aov, layer.components) ? OIIO::TypeHalf : OIIO::TypeFloat;
}

OIIO::ImageSpec exrSpec(const Picture& picture) {
    size_t channels = 0;
    for (const Layer& layer : picture.layers)
        channels += size_t(layer.components);
    OIIO::ImageSpec spec(picture.width, picture.height, int(channels), OIIO::TypeFloat);
    spec.channelnames.clear();
    for (const Layer& layer : picture.layers)
        for (const std::string& name :
             aovChannelNames(layer.aov, layer.components, layer.integer, layer.name)) {
            if (name == "A") spec.alpha_channel = int(spec.channelnames.size());
            spec.channelnames.push_back(name);
            spec.channelformats.push_back(channelType(layer));
        }
    const PictureInfo& info = picture.info;
    spec.x = info.x;
    spec.y = info.y;
    spec.full_width = info.fullWidth;
    spec.full_height = info.fullHeight;
    spec.attribute("PixelAspectRatio", info.pixelAspect);
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    spec.attribute("Software", info.software);
    spec.attribute("worldtocamera", OIIO::TypeMatrix, info.worldToCamera);
    spec.attribute("worldtoNDC", OIIO::TypeMatrix, info.worldToNdc);
    spec.attribute("hipr:scene", info.scene);
    spec.attribute("hipr:camera", info.camera);
    spec.attribute("hipr:frame", float(info.frame));
    spec.attribute("hipr:samples", int(info.samples));
    spec.attribute("hipr:renderTime", float(info.seconds));
    spec.attribute("hipr:settings", info.settings);
    for (const auto& [key, value] : cryptomatteMetadata(picture))
        spec.attribute(key, value);
    return spec;
}

/// Values as halves, which reach 65504.
std::vector<uint16_t> halves(const Layer& layer) {
    std::vector<float> values(layer.floats(), layer.floats() + layer.words.size());
    for (float& value : values)
        if (std::isfinite(value)) value = std::clamp(value, -65504.f, 65504.f);
    std::vector<uint16_t> result(values.size());
    OIIO::convert_pixel_values(OIIO::TypeFloat, values.data(), OIIO::TypeHalf, result.data(),
                               int(values.size()));
    return result;
}

/// The pixels as an EXR has them.
std::vector<uint8_t> interleaved(const Picture& picture, const OIIO::ImageSpec& spec) {
    const size_t pixels = size_t(picture.width) * size_t(picture.height), stride = spec.pixel_bytes(true);
    std::vector<uint8_t> data(pixels * stride);
    size_t first = 0;
    for (const Layer& layer : picture.layers) {
        const bool half = channelType(layer) == OIIO::TypeHalf;
        const std::vector<uint16_t> small = half ? halves(layer) : std::vector<uint16_t>();
        const void* const source = half ? static_cast<const void*>(small.data()) : layer.words.data();
        const size_t bytes = size_t(layer.components) * (half ? 2 : 4);
        for (size_t p = 0; p < pixels; ++p)
            std::memcpy(&data[p * stride + first], static_cast<const uint8_t*>(source) + p * bytes, bytes);
        first += bytes;
    }
    return data;
}

/// The picture as RGBA8, opaque over black unless alpha is kept.
std::vector<uint8_t> displayPixels(const std::string& path, const Picture& picture, const ViewTransform& view,
                                   bool alpha) {
    const Layer* color = picture.shown();
    if (!color || color->integer || color->components < 3) fail(path, "the picture has no color AOV");
    const size_t pixels = size_t(picture.width) * size_t(picture.height), n = size_t(color->components);
    std::vector<float> rgba(pixels * 4, 1.f);
    for (size_t p = 0; p < pixels; ++p)
        std::copy_n(color->floats() + p * n, alpha ? n : 3, &rgba[p * 4]);
    std::vector<uint8_t> bytes(pixels * 4);
    view.apply(rgba.data(), bytes.data(), pixels);
    return bytes;
}

void writeFile(const std::string& path, const OIIO::ImageSpec& spec, OIIO::TypeDesc format, const void* data,
               OIIO::stride_t pixelStride) {
    const fs::path temporary = temporaryPath(path);
    const auto output = OIIO::ImageOutput::create(path);
    if (!output) fail(path, OIIO::geterror());
    const bool ok = output->open(temporary.string(), spec) && output->write_image(format, data, pixelStride);
    const std::string why = ok ? "" : output->geterror();
    std::error_code error;
    if (!output->close() || !ok) {
        fs::remove(temporary, error);
        fail(path, why.empty() ? "the file could not be completed" : why);
    }
    fs::rename(temporary, path, error);
    if (!error) return;
    const std::string reason = error.message();
    fs::remove(temporary, error);
    fail(path, reason);
}

void writeDisplay(const std::string& path, const Picture& picture, const DisplayOptions& display) {
    const bool alpha = display.alpha && imageKind(path) == "png";
    const std::vector<uint8_t> bytes = displayPixels(path, picture, *display.view, alpha);
    OIIO::ImageSpec spec(picture.width, picture.height, alpha ? 4 : 3, OIIO::TypeUInt8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("Compression", "jpeg:95");
    spec.attribute("Software", picture.info.software);
    writeFile(path, spec, OIIO::TypeUInt8, bytes.data(), 4);
}

} // namespace

const Layer* Picture::find(const std::string& aov) const {
    for (const Layer& layer : layers)
        if (layer.aov == aov) return &layer;
    return nullptr;
}

const Layer* Picture::shown() const {
    for (const Layer& layer : layers)
        if (layer.name == "color") return &layer;
    const Layer* color = find("color");
    return color ? color : find("denoised");
}

std::string imageKind(const std::string& path) {
    std::string extension = fs::path(path).extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    if (extension == ".exr" || extension == ".png" || extension == ".jpg") return extension.substr(1);
    return extension == ".jpeg" ? "jpg" : "";
}

std::string whyNotWritable(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path, error)) return "it is a folder";
    const fs::path temporary = temporaryPath(path);
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file < 0) return std::strerror(errno);
    ::close(file);
    fs::remove(temporary, error);
    return "";
}

void writePicture(const std::string& path, const Picture& picture, const DisplayOptions& display) {
    if (imageKind(path) != "exr") return writeDisplay(path, picture, display);
    const OIIO::ImageSpec spec = exrSpec(picture);
    const std::vector<uint8_t> data = interleaved(picture, spec);
    writeFile(path, spec, OIIO::TypeUnknown, data.data(), OIIO::AutoStride);
}

} // namespace hipr::record
