#include "renderer/shading/image_file.h"

#include <filesystem>
#include <fstream>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

namespace hipr {

namespace {

namespace fs = std::filesystem;

/// A file that lives as long as this.
class TemporaryFile {
public:
    TemporaryFile(const std::vector<unsigned char>& bytes, const std::string& extension)
        : _path(fs::temp_directory_path() /
                fs::path(OIIO::Filesystem::unique_path("hipr-%%%%%%%%%%%%" + extension))) {
        std::ofstream out(_path, std::ios::binary);
        out.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
        if (!out) throw std::runtime_error("cannot write the temporary file " + _path.string());
    }
    ~TemporaryFile() {
        std::error_code ignored;
        fs::remove(_path, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    std::string path() const { return _path.string(); }

private:
    fs::path _path;
};

/// The extension that picks the reader, dot included. A path inside a package ends in `[inner.png]`.
std::string extensionOf(const std::string& path) {
    std::string name = path;
    if (!name.empty() && name.back() == ']') name.pop_back();
    return fs::path(name.substr(name.find_last_of("[/") + 1)).extension().string();
}

WrapMode wrapMode(const std::string& name) {
    if (name == "clamp") return WrapMode::Clamp;
    if (name == "periodic" || name == "repeat") return WrapMode::Repeat;
    if (name == "mirror") return WrapMode::Mirror;
    return WrapMode::Black;
}

/// "s,t" or one mode for both: the attribute `wrapmodes` of OpenImageIO.
void readWrapModes(const OIIO::ImageSpec& spec, ImageFile& file) {
    const std::string modes = spec.get_string_attribute("wrapmodes");
    const size_t comma = modes.find(',');
    file.wrapS = wrapMode(modes.substr(0, comma));
    file.wrapT = comma == std::string::npos ? file.wrapS : wrapMode(modes.substr(comma + 1));
}

/// Whether a file of `stored` bytes can hold `decoded` bytes of pixels. A damaged header may ask for any
/// size, and memory that is only promised ends the process when it is touched; no lossless format packs
/// better than about 1000 : 1.
bool plausibleSize(size_t stored, size_t decoded) {
    constexpr size_t Harmless = size_t(256) << 20, BestRatio = 4000;
    return decoded <= Harmless || decoded / BestRatio <= stored;
}

bool readPixels(OIIO::ImageInput& input, size_t stored, ImageFile& file, std::string& error) {
    constexpr int LargestSide = 65536;
    const OIIO::ImageSpec& spec = input.spec();
    if (spec.width <= 0 || spec.height <= 0 || spec.width > LargestSide || spec.height > LargestSide ||
        spec.depth > 1 || spec.deep || spec.nchannels < 1) {
        error = "not a flat picture of at most 65536 x 65536 pixels";
        return false;
    }
    file.width = uint32_t(spec.width);
    file.height = uint32_t(spec.height);
    file.channels = std::min(spec.nchannels, 4);
    file.eightBit = spec.format == OIIO::TypeDesc::UINT8;
    readWrapModes(spec, file);
    const OIIO::TypeDesc type = file.eightBit ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    const size_t decoded = size_t(file.width) * file.height * size_t(file.channels) * type.size();
    if (!plausibleSize(stored, decoded)) {
        error = "damaged: too short for its " + std::to_string(file.width) + " x " +
                std::to_string(file.height) + " pixels";
        return false;
    }
    file.pixels.resize(decoded);
    if (input.read_image(0, 0, 0, file.channels, type, file.pixels.data())) return true;
    error = input.geterror();
    return false;
}

/// Takes the error that OpenImageIO keeps per thread, which it would print at exit otherwise.
std::string takeError() {
    const std::string text = OIIO::geterror();
    return text.empty() ? "not a picture in a known format" : text;
}

} // namespace

bool readImageFile(const std::vector<unsigned char>& bytes, const std::string& path, ImageFile& file,
                   std::string& error) {
    const std::string extension = extensionOf(path);
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    OIIO::Filesystem::IOMemReader memory(bytes.data(), bytes.size());
    const auto reader = OIIO::ImageInput::create("image" + extension);
    takeError();
    if (reader && reader->supports("ioproxy")) {
        if (const auto input = OIIO::ImageInput::open("image" + extension, &config, &memory))
            return readPixels(*input, bytes.size(), file, error);
        error = takeError();
        return false;
    }
    const TemporaryFile temporary(bytes, extension);
    if (const auto input = OIIO::ImageInput::open(temporary.path(), &config))
        return readPixels(*input, bytes.size(), file, error);
    error = takeError();
    return false;
}

} // namespace hipr
