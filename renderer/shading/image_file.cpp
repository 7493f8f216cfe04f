#include "renderer/shading/image_file.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>

namespace hipr {

namespace {

namespace fs = std::filesystem;

constexpr int BandRows = 64; ///< of pictures that are not stored in tiles

/// Of this process alone: other users of OpenImageIO keep their settings. Never destroyed, for static objects
/// of other libraries that it uses may be gone before.
OIIO::ImageCache& cache() {
    static OIIO::ImageCache& made = [&]() -> OIIO::ImageCache& {
        OIIO::ImageCache& cache = *OIIO::ImageCache::create(false);
        cache.attribute("max_memory_MB", float(ImageFile::CacheMegabytes));
        cache.attribute("autotile", BandRows);
        cache.attribute("autoscanline", 1);
        cache.attribute("unassociatedalpha", 1);
        cache.attribute("deduplicate", 0); // files come and go
        return cache;
    }();
    return made;
}

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
void readWrapModes(const OIIO::ImageSpec& spec, ImageHeader& header) {
    const std::string modes = spec.get_string_attribute("wrapmodes");
    const size_t comma = modes.find(',');
    header.wrapS = wrapMode(modes.substr(0, comma));
    header.wrapT = comma == std::string::npos ? header.wrapS : wrapMode(modes.substr(comma + 1));
}

/// Whether a file of `stored` bytes can hold `decoded` bytes of pixels. A damaged header may ask for any
/// size, and memory that is only promised ends the process when it is touched; no lossless format packs
/// better than about 1000 : 1.
bool plausibleSize(size_t stored, size_t decoded) {
    constexpr size_t Harmless = size_t(256) << 20, BestRatio = 4000;
    return decoded <= Harmless || decoded / BestRatio <= stored;
}

/// Takes the error that OpenImageIO keeps per thread, which it would print at exit otherwise, and the
/// cache's: one line, without the name that the file has here alone.
std::string takeError(const OIIO::ustring& name) {
    std::string text = cache().geterror();
    const std::string other = OIIO::geterror();
    if (text.empty()) text = other;
    text = text.substr(0, text.find('\n'));
    const std::string quoted = '"' + name.string() + '"';
    for (size_t at = text.find(quoted); at != text.npos; at = text.find(quoted)) {
        const bool begins = at == 0; // a sentence
        text.replace(begins ? 0 : at - 1, quoted.size() + !begins, begins ? "it" : "");
    }
    return text.empty() ? "not a picture in a known format" : text;
}

bool readsThroughProxy(const std::string& extension) {
    const auto reader = OIIO::ImageInput::create("image" + extension);
    OIIO::geterror();
    return reader && reader->supports("ioproxy");
}

} // namespace

/// Where the cache reads a file from, under a name of its own: files may change between two times of being
/// opened.
struct ImageFile::Source {
    std::vector<unsigned char> bytes;
    std::unique_ptr<OIIO::Filesystem::IOProxy> proxy;
    fs::path temporary; ///< for formats that are read from disk alone
    size_t stored = 0;  ///< bytes
    OIIO::ustring name;

    bool open(const std::string& path, const AssetReader& assets);
    ~Source();
};

bool ImageFile::Source::open(const std::string& path, const AssetReader& assets) {
    std::error_code failure;
    const bool onDisk = fs::is_regular_file(path, failure);
    if (onDisk)
        stored = size_t(fs::file_size(path));
    else
        bytes = assets(path), stored = bytes.size();
    if (stored == 0) return false;
    static std::atomic<uint64_t> count{0};
    const std::string extension = extensionOf(path);
    if (!readsThroughProxy(extension)) {
        temporary = fs::temp_directory_path() /
                    fs::path(OIIO::Filesystem::unique_path("hipr-%%%%%%%%%%%%" + extension));
        if (onDisk)
            fs::create_symlink(fs::absolute(path), temporary);
        else if (!(std::ofstream(temporary, std::ios::binary)
                       .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()))))
            throw std::runtime_error("cannot write the temporary file " + temporary.string());
        name = OIIO::ustring(temporary.string());
        bytes = std::vector<unsigned char>();
        return true;
    }
    name = OIIO::ustring("hipr" + std::to_string(++count) + extension);
    if (onDisk)
        proxy = std::make_unique<OIIO::Filesystem::IOFile>(path, OIIO::Filesystem::IOProxy::Read);
    else
        proxy = std::make_unique<OIIO::Filesystem::IOMemReader>(bytes.data(), bytes.size());
    OIIO::Filesystem::IOProxy* const address = proxy.get();
    OIIO::ImageSpec config;
    config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &address);
    cache().add_file(name, nullptr, &config);
    return true;
}

ImageFile::Source::~Source() {
    if (!name.empty()) cache().invalidate(name, true);
    std::error_code ignored;
    if (!temporary.empty()) fs::remove(temporary, ignored);
}

ImageFile::ImageFile() : _source(std::make_unique<Source>()) {}
ImageFile::~ImageFile() = default;

std::unique_ptr<ImageFile> ImageFile::open(const std::string& path, const AssetReader& assets,
                                           std::string& error) {
    std::unique_ptr<ImageFile> file(new ImageFile());
    if (!file->_source->open(path, assets) || !file->readHeader(error)) return nullptr;
    return file;
}

bool ImageFile::readHeader(std::string& error) {
    constexpr int LargestSide = 65536;
    OIIO::ImageSpec spec;
    if (!cache().get_imagespec(_source->name, spec, 0, 0, true)) {
        error = takeError(_source->name);
        return false;
    }
    if (spec.width <= 0 || spec.height <= 0 || spec.width > LargestSide || spec.height > LargestSide ||
        spec.depth > 1 || spec.deep || spec.nchannels < 1) {
        error = "not a flat picture of at most 65536 x 65536 pixels";
        return false;
    }
    _left = spec.x;
    _top = spec.y;
    _header.channels = std::min(spec.nchannels, 4);
    _header.eightBit = spec.format == OIIO::TypeDesc::UINT8;
    _header.large = spec.format == OIIO::TypeDesc::FLOAT || spec.format == OIIO::TypeDesc::DOUBLE;
    _header.levels = {{uint32_t(spec.width), uint32_t(spec.height)}};
    readWrapModes(spec, _header);
    const size_t decoded =
        size_t(spec.width) * size_t(spec.height) * size_t(_header.channels) * (_header.eightBit ? 1 : 4);
    if (!plausibleSize(_source->stored, decoded)) {
        error = "damaged: too short for its " + std::to_string(spec.width) + " x " +
                std::to_string(spec.height) + " pixels";
        return false;
    }
    int stored = 1;
    cache().get_image_info(_source->name, 0, 0, OIIO::ustring("miplevels"), OIIO::TypeDesc::INT, &stored);
    while (int(_header.levels.size()) < stored) { // those that are halves, as far as there are any
        const LevelSize expected = coarserLevel(_header.levels.back());
        if (!cache().get_imagespec(_source->name, spec, 0, int(_header.levels.size()), true) ||
            !(LevelSize{uint32_t(spec.width), uint32_t(spec.height)} == expected) || spec.x != 0 ||
            spec.y != 0)
            break;
        _header.levels.push_back(expected);
    }
    return true;
}

bool ImageFile::read(size_t level, uint32_t firstRow, uint32_t rows, void* pixels, std::string& error) {
    const OIIO::TypeDesc type = _header.eightBit ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT;
    const int left = level == 0 ? _left : 0, top = (level == 0 ? _top : 0) + int(firstRow);
    if (cache().get_pixels(_source->name, 0, int(level), left, left + int(_header.levels[level].width), top,
                           top + int(rows), 0, 1, 0, _header.channels, type, pixels))
        return true;
    error = takeError(_source->name);
    return false;
}

} // namespace hipr
