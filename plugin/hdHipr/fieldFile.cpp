#include "plugin/hdHipr/fieldFile.h"

#include <filesystem>
#include <map>
#include <mutex>
#include <tuple>

#include "plugin/hdHipr/compatAssets.h"
#include "plugin/hdHipr/messages.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

namespace fs = std::filesystem;

/// What tells one content from another: path, grid, index, and when the file was written.
using Key = std::tuple<std::string, std::string, int, fs::file_time_type>;

std::mutex cacheMutex;
std::map<Key, std::weak_ptr<const hipr::FieldGrid>> cache; ///< guarded by cacheMutex

std::shared_ptr<const hipr::FieldGrid> cached(Key const& key) {
    const std::lock_guard<std::mutex> lock(cacheMutex);
    const auto found = cache.find(key);
    return found == cache.end() ? nullptr : found->second.lock();
}

void keep(Key const& key, std::shared_ptr<const hipr::FieldGrid> const& grid) {
    const std::lock_guard<std::mutex> lock(cacheMutex);
    for (auto it = cache.begin(); it != cache.end();) {
        it = it->second.expired() ? cache.erase(it) : std::next(it);
    }
    cache[key] = grid;
}

void forgetAll() {
    const std::lock_guard<std::mutex> lock(cacheMutex);
    cache.clear();
}

std::shared_ptr<const hipr::FieldGrid> told(SdfPath const& field, hipr::FieldFile const& file) {
    for (std::string const& text : {file.error, file.warning}) {
        if (!text.empty()) {
            warnOnce(field.GetString(), text);
        }
    }
    return file.grid;
}

/// The grid of an asset by its resolved path, or null; what is wrong is said of `field`.
std::shared_ptr<const hipr::FieldGrid> fieldGrid(SdfPath const& field, std::string const& path,
                                                 hipr::FieldChoice const& choice) {
    std::error_code none;
    if (!fs::is_regular_file(path, none)) { // in a package, or of a resolver's own
        const AssetBytes asset = openAsset(path);
        if (!asset.data) {
            warnOnce(field.GetString(), "'" + path + "' cannot be opened");
            return nullptr;
        }
        return told(field, hipr::readVdbMemory(asset.data.get(), asset.size, path, choice));
    }
    const Key key{path, choice.grid, choice.index, fs::last_write_time(path, none)};
    if (const auto grid = cached(key)) {
        return grid;
    }
    const auto grid = told(field, hipr::readVdbFile(path, choice));
    if (grid) {
        keep(key, grid);
    }
    return grid;
}

} // namespace

void ShownFields::set(hipr::FieldId id, SdfPath const& field, std::string const& path,
                      hipr::FieldChoice const& choice, hipr::SceneEdit& edit) {
    if (path.empty()) {
        warnOnce(field.GetString(), "it names no file");
        remove(id, edit);
        return;
    }
    {
        const std::lock_guard<std::mutex> lock(_mutex);
        _entries[id] = {field, path, choice};
    }
    edit.setField(id, fieldGrid(field, path, choice));
}

void ShownFields::remove(hipr::FieldId id, hipr::SceneEdit& edit) {
    const std::lock_guard<std::mutex> lock(_mutex);
    _entries.erase(id);
    edit.removeField(id);
}

void ShownFields::readAgain(hipr::SceneEdit& edit) {
    const std::lock_guard<std::mutex> lock(_mutex);
    forgetAll();
    for (auto const& [id, entry] : _entries) {
        edit.setField(id, fieldGrid(entry.field, entry.path, entry.choice));
    }
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
