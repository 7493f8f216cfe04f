#include "renderer/shading/texture_source.h"

#include <algorithm>
#include <new>

#include <tbb/parallel_for.h>

#include "renderer/shading/dome_format.h"

namespace hipr {

namespace {

constexpr size_t TilesPerRow = 10, MostTiles = 8999; // UDIM numbers 1001 to 9999
constexpr size_t PicturesAtATime = 32; // bounds the memory that decoded pictures take before their upload

struct Job {
    TextureSource* source;
    size_t tile;
    Image image;
    std::string error; ///< empty: a UDIM tile that does not exist, or no error
    bool decoded = false;
};

void decode(Job& job, const AssetReader& assets, const ColorManager& color) {
    const std::string path = job.source->tilePath(job.tile);
    try {
        const std::vector<unsigned char> bytes = assets(path);
        if (!bytes.empty())
            job.decoded = decodeImage(bytes, path, job.source->colorSpace, color, job.image, job.error);
        else if (!job.source->udim())
            job.error = "cannot be read";
        job.image = toLatLong(std::move(job.image), job.source->format);
    } catch (const std::exception& e) { // the host's reader
        job.error = reasonOf(e);
    }
}

void upload(Job& job, Device& device) {
    TextureTile& tile = job.source->tiles[job.tile];
    try {
        tile.buffer = device.createFrom(job.image.texels.data(), job.image.texels.size(), "textures");
    } catch (const std::bad_alloc&) {
        job.error = "does not fit into the device's memory";
        return;
    }
    tile.image = std::move(job.image);
    if (!job.source->keepPixels) tile.image.texels = {};
}

void run(std::vector<Job>& jobs, Device& device, const AssetReader& assets, const ColorManager& color) {
    for (size_t first = 0; first < jobs.size(); first += PicturesAtATime) {
        const size_t end = std::min(first + PicturesAtATime, jobs.size());
        tbb::parallel_for(first, end, [&](size_t i) { decode(jobs[i], assets, color); });
        for (size_t i = first; i < end; ++i) {
            Job& job = jobs[i];
            if (job.decoded) upload(job, device);
            if (!job.error.empty() && device.messages())
                device.messages()(Severity::Warning, job.source->subject,
                                  "texture " + job.source->tilePath(job.tile) + ": " + job.error);
        }
    }
}

/// Whether a UDIM set may have tiles beyond those looked for: sets have gaps, so a hundred absent numbers end
/// it.
bool wantsMoreTiles(const TextureSource& source) {
    constexpr size_t Gap = 100;
    const size_t count = source.tiles.size();
    if (!source.udim() || count >= MostTiles) return false;
    return count < Gap || std::any_of(source.tiles.end() - Gap, source.tiles.end(),
                                      [](const TextureTile& tile) { return tile.loaded(); });
}

void dropAbsentTail(TextureSource& source) {
    while (source.tiles.size() > 1 && !source.tiles.back().loaded())
        source.tiles.pop_back();
}

} // namespace

std::string TextureSource::tilePath(size_t tile) const {
    const size_t at = path.find("<UDIM>");
    if (at == std::string::npos) return path;
    return path.substr(0, at) + std::to_string(1001 + tile) + path.substr(at + 6);
}

void loadTextureSources(const std::vector<TextureSource*>& sources, Device& device, const AssetReader& assets,
                        const ColorManager& color) {
    std::vector<TextureSource*> open = sources;
    while (!open.empty()) {
        std::vector<Job> jobs;
        for (TextureSource* source : open) {
            const size_t first = source->tiles.size();
            source->tiles.resize(source->udim() ? std::min(first + TilesPerRow, MostTiles) : 1);
            for (size_t tile = first; tile < source->tiles.size(); ++tile)
                jobs.push_back({source, tile, {}, {}, false});
        }
        run(jobs, device, assets, color);
        open.erase(
            std::remove_if(open.begin(), open.end(), [](TextureSource* s) { return !wantsMoreTiles(*s); }),
            open.end());
    }
    for (TextureSource* source : sources) {
        source->loaded = true;
        dropAbsentTail(*source);
        if (source->udim() && !source->tiles[0].loaded() && source->tiles.size() == 1 && device.messages())
            device.messages()(Severity::Warning, source->subject,
                              "texture " + source->path + ": no tile from 1001 on can be read");
    }
}

} // namespace hipr
