#include "renderer/shading/textures.h"

#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "renderer/shading/texture_source.h"

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
    using SourceKey = std::tuple<std::string, std::string, DomeFormat>; ///< path, colour space, projection

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
    Buffer records;

    TextureSource* source(const TextureRequest& request, const std::string& subject);
    void collectUnused();
    void load();
    void rebuild();
};

TextureSource* TextureStore::Impl::source(const TextureRequest& request, const std::string& subject) {
    auto& source = sources[{request.path, request.colorSpace, request.format}];
    if (!source) {
        source = std::make_unique<TextureSource>();
        source->path = request.path;
        source->colorSpace = request.colorSpace;
        source->format = request.format;
        source->subject = subject;
    }
    if (request.keepPixels && !source->keepPixels) {
        source->keepPixels = true;
        if (source->loaded) source->loaded = false, source->tiles.clear(); // pixels are gone: read it again
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
    std::vector<TextureSource*> wanted;
    for (auto& entry : sources)
        if (!entry.second->loaded) wanted.push_back(entry.second.get());
    loadTextureSources(wanted, device, assets, *color);
}

void TextureStore::Impl::rebuild() {
    std::vector<gpu::TextureRecord> table;
    for (auto& entry : textures) {
        Texture& texture = entry.second;
        const bool udim = texture.source->udim();
        texture.range = {uint32_t(table.size()), udim ? uint32_t(texture.source->tiles.size()) : 0u};
        for (const TextureTile& tile : texture.source->tiles)
            table.push_back(describeTile(tile, texture.request, udim));
    }
    records = device.createFrom(table.data(), table.size(), "textures");
    ++version;
}

TextureStore::TextureStore(Device& device, AssetReader assets, std::shared_ptr<const ColorManager> color)
    : _impl(std::make_unique<Impl>(device, assets ? std::move(assets) : AssetReader(readFile),
                                   std::move(color))) {
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
        tile.image.texels = {};
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
