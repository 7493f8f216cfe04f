#include "renderer/shading/texture_source.h"

#include <algorithm>
#include <new>

#include <tbb/parallel_for.h>

#include "renderer/shading/dome_format.h"

namespace hipr {

namespace {

constexpr size_t TilesPerRow = 10, MostTiles = 8999; // UDIM numbers 1001 to 9999

/// Whether a UDIM set may have tiles beyond those looked for: sets have gaps, so a hundred absent numbers end
/// it.
bool wantsMoreTiles(const TextureSource& source) {
    constexpr size_t Gap = 100;
    const size_t count = source.tiles.size();
    if (!source.udim() || count >= MostTiles) return false;
    return count < Gap || std::any_of(source.tiles.end() - Gap, source.tiles.end(),
                                      [](const TextureTile& tile) { return tile.exists(); });
}

void dropAbsentTail(TextureSource& source) {
    while (source.tiles.size() > 1 && !source.tiles.back().exists())
        source.tiles.pop_back();
}

} // namespace

uint64_t TextureTile::bytes(uint32_t first) const {
    std::vector<LevelSize> sizes = levelSizes(header.levels[0]);
    sizes.erase(sizes.begin(), sizes.begin() + first);
    return levelBytes(sizes, format);
}

std::string TextureSource::tilePath(size_t tile) const {
    const size_t at = path.find("<UDIM>");
    if (at == std::string::npos) return path;
    return path.substr(0, at) + std::to_string(1001 + tile) + path.substr(at + 6);
}

struct TextureLoader::Job {
    TextureSource* source;
    size_t number; ///< of the tile
    std::string error{};

    TextureTile& tile() const { return source->tiles[number]; }
};

void TextureLoader::run(std::vector<Job>& jobs, void (TextureLoader::*work)(Job&) const) const {
    const auto guarded = [&](Job& job) {
        try {
            (this->*work)(job);
        } catch (const DeviceLost&) {
            throw;
        } catch (const std::exception& e) { // the host's reader
            job.error = reasonOf(e);
        }
    };
    tbb::parallel_for(size_t(0), jobs.size(), [&](size_t i) { guarded(jobs[i]); });
    for (const Job& job : jobs)
        if (!job.error.empty() && _device.messages())
            _device.messages()(Severity::Warning, job.source->subject,
                               "texture " + job.source->tilePath(job.number) + ": " + job.error);
}

void TextureLoader::examine(Job& job) const {
    const auto file = ImageFile::open(job.source->tilePath(job.number), _assets, job.error);
    if (file) {
        job.tile().header = file->header();
        job.tile().format = texelFormat(file->header(), job.source->colorSpace, _color);
    } else if (job.error.empty() && !job.source->udim()) {
        job.error = "cannot be read";
    }
}

void TextureLoader::examine(const std::vector<TextureSource*>& sources) const {
    std::vector<TextureSource*> open = sources;
    while (!open.empty()) {
        std::vector<Job> jobs;
        for (TextureSource* source : open) {
            const size_t first = source->tiles.size();
            source->tiles.resize(source->udim() ? std::min(first + TilesPerRow, MostTiles) : 1);
            for (size_t tile = first; tile < source->tiles.size(); ++tile)
                jobs.push_back({source, tile});
        }
        run(jobs, &TextureLoader::examine);
        open.erase(
            std::remove_if(open.begin(), open.end(), [](TextureSource* s) { return !wantsMoreTiles(*s); }),
            open.end());
    }
    for (TextureSource* source : sources) {
        source->examined = true;
        dropAbsentTail(*source);
        if (source->udim() && !source->tiles[0].exists() && source->tiles.size() == 1 && _device.messages())
            _device.messages()(Severity::Warning, source->subject,
                               "texture " + source->path + ": no tile from 1001 on can be read");
    }
}

void TextureLoader::decode(Job& job, ImageFile& file, Image& image) const {
    const TextureSource& source = *job.source;
    if (!source.ofLight)
        decodeLevels(file, source.colorSpace, _color, job.tile().finest, image, job.error);
    else if (decodeImage(file, source.colorSpace, _color, image, job.error))
        image = toLatLong(std::move(image), source.format);
}

void TextureLoader::load(Job& job) const {
    TextureTile& tile = job.tile();
    tile.tried = true;
    const auto file = ImageFile::open(job.source->tilePath(job.number), _assets, job.error);
    if (!file && job.error.empty()) job.error = "cannot be read any more";
    if (!file) return;
    Image image;
    decode(job, *file, image);
    if (!job.error.empty()) return;
    try {
        tile.buffer = _device.createFrom(image.texels.data(), image.texels.size(), "textures");
    } catch (const std::bad_alloc&) {
        job.error = "does not fit into the device's memory";
        return;
    }
    tile.image = std::move(image);
    // Not {}, which keeps the capacity.
    if (!job.source->keepPixels) tile.image.texels = std::vector<unsigned char>();
}

void TextureLoader::load(const std::vector<TextureSource*>& sources) const {
    std::vector<Job> jobs;
    for (TextureSource* source : sources)
        for (size_t i = 0; i < source->tiles.size(); ++i)
            if (source->tiles[i].exists() && !source->tiles[i].tried) jobs.push_back({source, i});
    run(jobs, &TextureLoader::load);
}

} // namespace hipr
