#include "renderer/shading/textures.h"

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "renderer/shading/texture_limit.h"

namespace hipr {

namespace {

std::vector<unsigned char> readFile(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

uint32_t wrapCode(WrapMode requested, WrapMode metadata) {
    switch (requested == WrapMode::UseMetadata ? metadata : requested) {
    case WrapMode::Clamp:
        return gpu::WRAP_CLAMP;
    case WrapMode::Repeat:
        return gpu::WRAP_REPEAT;
    case WrapMode::Mirror:
        return gpu::WRAP_MIRROR;
    default:
        return gpu::WRAP_BLACK;
    }
}

gpu::TextureRecord describeTile(const TextureTile& tile, const TextureRequest& request, bool udim) {
    gpu::TextureRecord record{};
    record.format = gpu::TEXEL_NONE;
    if (!tile.loaded()) return record;
    record.texels = tile.buffer.address();
    record.width = tile.image.width;
    record.height = tile.image.height;
    record.format = tile.image.format;
    // A tile is met by coordinates inside it alone; its border texels reach to its edge.
    record.wrapS = udim ? gpu::WRAP_CLAMP : wrapCode(request.wrapS, tile.image.wrapS);
    record.wrapT = udim ? gpu::WRAP_CLAMP : wrapCode(request.wrapT, tile.image.wrapT);
    return record;
}

/// Adds the records of a tile's coarser levels to the table, and names them in that of the finest.
void describeCoarser(std::vector<gpu::TextureRecord>& table, size_t finest) {
    gpu::TextureRecord level = table[finest];
    const std::vector<LevelSize> sizes = levelSizes({level.width, level.height});
    table[finest].firstCoarser = uint32_t(table.size());
    table[finest].coarserLevels = uint32_t(sizes.size() - 1);
    if (level.wrapS == gpu::WRAP_BLACK) level.wrapS = gpu::WRAP_CUT;
    if (level.wrapT == gpu::WRAP_BLACK) level.wrapT = gpu::WRAP_CUT;
    for (size_t i = 1; i < sizes.size(); ++i) {
        level.texels += levelBytes({sizes[i - 1]}, level.format);
        level.width = sizes[i].width;
        level.height = sizes[i].height;
        table.push_back(level);
    }
}

std::string megabytes(uint64_t bytes) {
    return std::to_string((bytes + (1 << 20) - 1) >> 20) + " MiB";
}

} // namespace

bool TextureRequest::operator<(const TextureRequest& o) const {
    return std::tie(path, colorSpace, wrapS, wrapT, keepPixels, format) <
           std::tie(o.path, o.colorSpace, o.wrapS, o.wrapT, o.keepPixels, o.format);
}

struct TextureStore::Impl {
    struct Texture {
        TextureRequest request;
        TextureSource* source;
        uint32_t users;
        TextureRange range;
    };
    /// Path, colour space, projection, whether a light shows it.
    using SourceKey = std::tuple<std::string, std::string, DomeFormat, bool>;

    Impl(Device& device, AssetReader assets, std::shared_ptr<const ColorManager> color)
        : device(device), assets(std::move(assets)), color(std::move(color)) {}

    Device& device;
    AssetReader assets;
    std::shared_ptr<const ColorManager> color;
    std::map<SourceKey, std::unique_ptr<TextureSource>> sources;
    std::map<TextureRequest, uint32_t> numbers;
    std::map<uint32_t, Texture> textures;
    uint32_t nextNumber = 0;
    uint32_t version = 0;
    bool changed = false; ///< since the last commit
    uint64_t limit = 0;
    TextureFit told; ///< of the last message
    Buffer records;

    TextureSource* source(const TextureRequest& request, const std::string& subject);
    void collectUnused();
    void load();
    void fit(const std::vector<TextureSource*>& all);
    void rebuild();
};

TextureSource* TextureStore::Impl::source(const TextureRequest& request, const std::string& subject) {
    auto& source = sources[{request.path, request.colorSpace, request.format, request.keepPixels}];
    if (!source) {
        source = std::make_unique<TextureSource>();
        source->path = request.path;
        source->colorSpace = request.colorSpace;
        source->format = request.format;
        source->ofLight = request.keepPixels;
        source->subject = subject;
    }
    if (request.keepPixels && !source->keepPixels) {
        source->keepPixels = true;
        for (TextureTile& tile : source->tiles) // pixels are gone: read it again
            tile.tried = false;
    }
    ++source->users;
    return source.get();
}

void TextureStore::Impl::collectUnused() {
    for (auto it = textures.begin(); it != textures.end();) {
        if (it->second.users == 0) {
            --it->second.source->users;
            numbers.erase(it->second.request);
            it = textures.erase(it);
        } else {
            ++it;
        }
    }
    for (auto it = sources.begin(); it != sources.end();)
        it = it->second->users == 0 ? sources.erase(it) : std::next(it);
}

void TextureStore::Impl::load() {
    const TextureLoader loader(device, assets, *color);
    std::vector<TextureSource*> all, unknown;
    for (auto& entry : sources) {
        all.push_back(entry.second.get());
        if (!entry.second->examined) unknown.push_back(entry.second.get());
    }
    loader.examine(unknown);
    fit(all);
    loader.load(all);
}

/// Frees what no longer has the levels it should have before anything else is loaded.
void TextureStore::Impl::fit(const std::vector<TextureSource*>& all) {
    std::map<const TextureTile*, uint32_t> before;
    for (const TextureSource* source : all)
        for (const TextureTile& tile : source->tiles)
            before[&tile] = tile.finest;
    const TextureFit result = fitTextures(all, limit);
    for (TextureSource* source : all)
        for (TextureTile& tile : source->tiles)
            if (tile.finest != before[&tile]) tile.buffer = {}, tile.tried = false;
    const bool same = result.wanted == told.wanted && result.taken == told.taken;
    if (result.reduced > 0 && !same && device.messages())
        device.messages()(Severity::Warning, "",
                          "textures take " + megabytes(result.wanted) + ", and hipr:textureMemory allows " +
                              megabytes(limit) + ": " + std::to_string(result.reduced) + " of " +
                              std::to_string(result.pictures) +
                              " pictures are shown without their finest levels, which takes " +
                              megabytes(result.taken));
    told = result;
}

void TextureStore::Impl::rebuild() {
    std::vector<gpu::TextureRecord> table;
    for (auto& entry : textures) {
        Texture& texture = entry.second;
        const bool udim = texture.source->udim();
        texture.range = {uint32_t(table.size()), udim ? uint32_t(texture.source->tiles.size()) : 0u};
        const std::vector<TextureTile>& tiles = texture.source->tiles;
        for (const TextureTile& tile : tiles)
            table.push_back(describeTile(tile, texture.request, udim));
        for (size_t i = 0; i < tiles.size() && !texture.source->ofLight; ++i)
            if (tiles[i].loaded()) describeCoarser(table, texture.range.first + i);
    }
    records = device.createFrom(table.data(), table.size(), "textures");
    ++version;
}

TextureStore::TextureStore(Device& device, AssetReader assets, std::shared_ptr<const ColorManager> color)
    : _impl(std::make_unique<Impl>(device, assets ? std::move(assets) : AssetReader(readFile),
                                   std::move(color))) {
    setLimit(0);
    _impl->rebuild();
}

TextureStore::~TextureStore() = default;

uint32_t TextureStore::acquire(const TextureRequest& request, const std::string& subject) {
    const auto known = _impl->numbers.find(request);
    if (known != _impl->numbers.end()) {
        ++_impl->textures.at(known->second).users;
        return known->second;
    }
    const uint32_t number = _impl->nextNumber++;
    _impl->numbers[request] = number;
    _impl->textures[number] = {request, _impl->source(request, subject), 1, {}};
    _impl->changed = true;
    return number;
}

void TextureStore::release(uint32_t texture) {
    Impl::Texture& entry = _impl->textures.at(texture);
    if (--entry.users == 0) _impl->changed = true;
}

void TextureStore::setLimit(uint64_t bytes) {
    const uint64_t limit = bytes > 0 ? bytes : std::max<uint64_t>(_impl->device.info().memoryBytes / 2, 1);
    _impl->changed = _impl->changed || limit != _impl->limit;
    _impl->limit = limit;
}

bool TextureStore::commit() {
    if (!_impl->changed) return false;
    _impl->collectUnused();
    _impl->load();
    _impl->rebuild();
    _impl->changed = false;
    return true;
}

TextureRange TextureStore::range(uint32_t texture) const {
    return _impl->textures.at(texture).range;
}

bool TextureStore::opaque(uint32_t texture) const {
    for (const TextureTile& tile : _impl->textures.at(texture).source->tiles)
        if (!tile.loaded() || !tile.image.opaque) return false;
    return true;
}

const Image* TextureStore::image(uint32_t texture) const {
    const TextureSource& source = *_impl->textures.at(texture).source;
    return source.tiles.size() == 1 && source.tiles[0].loaded() ? &source.tiles[0].image : nullptr;
}

void TextureStore::releasePixels(uint32_t texture) {
    TextureSource& source = *_impl->textures.at(texture).source;
    source.keepPixels = false;
    for (TextureTile& tile : source.tiles)
        tile.image.texels = std::vector<unsigned char>();
}

uint32_t TextureStore::version() const {
    return _impl->version;
}

const AssetReader& TextureStore::assets() const {
    return _impl->assets;
}

void TextureStore::describe(gpu::SceneRecord& scene) const {
    scene.textures = _impl->records.address();
}

} // namespace hipr
