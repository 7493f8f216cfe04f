#include "plugin/hdHipr/renderParam.h"

#include <algorithm>
#include <utility>

#include "plugin/hdHipr/messages.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

/// What a prim is taken for a part of. Hydra does not tell which prims are models, so it is the second prim
/// of the path: "/World/Chair" of "/World/Chair/Geo/Leg".
std::string assetOf(SdfPath const& path) {
    const SdfPathVector prefixes = path.GetPrefixes();
    return prefixes.empty() ? std::string() : prefixes[prefixes.size() > 1 ? 1 : 0].GetString();
}

} // namespace

HdHiprRenderParam::HdHiprRenderParam(hipr::RendererOptions const& options) {
    std::string error;
    std::unique_ptr<hipr::Renderer> renderer = hipr::Renderer::create(options, &error);
    if (renderer) {
        report(hipr::Severity::Info, "", "rendering on " + renderer->device().name);
        _loop = std::make_unique<RenderLoop>(std::move(renderer));
    } else {
        report(hipr::Severity::Error, "", "cannot render: " + error);
    }
}

hipr::MaterialId HdHiprRenderParam::materialId(SdfPath const& path) {
    if (path.IsEmpty()) {
        return hipr::MaterialId::None;
    }
    std::lock_guard<std::mutex> lock(_mutex);
    hipr::MaterialId& id = _materials[path];
    if (id == hipr::MaterialId::None) {
        id = newId<hipr::MaterialId>();
    }
    return id;
}

void HdHiprRenderParam::setMaterial(SdfPath const& path, std::optional<hipr::MaterialDesc> const& desc) {
    const hipr::MaterialId id = materialId(path);
    if (desc) {
        _edit.setMaterial(id, *desc);
    } else { // without a surface the mesh shows its displayColor
        _edit.removeMaterial(id);
    }
    _shiningMaterials.baseChanged(path, desc, _edit);
}

hipr::FieldId HdHiprRenderParam::fieldId(SdfPath const& path) {
    std::lock_guard<std::mutex> lock(_mutex);
    hipr::FieldId& id = _fields[path];
    if (id == hipr::FieldId::None) {
        id = newId<hipr::FieldId>();
    }
    return id;
}

bool HdHiprRenderParam::included(ObjectState const& state) const {
    const auto above = [&](SdfPath const& path) { return state.path.HasPrefix(path); };
    const bool tagged = _renderTags.empty() || std::find(_renderTags.begin(), _renderTags.end(),
                                                         state.renderTag) != _renderTags.end();
    const bool rooted = _rootPaths.empty() || std::any_of(_rootPaths.begin(), _rootPaths.end(), above);
    return tagged && rooted && std::none_of(_excludePaths.begin(), _excludePaths.end(), above);
}

/// Called under _mutex.
void HdHiprRenderParam::emitObject(hipr::ObjectId id, ObjectState const& state) {
    hipr::ObjectDesc desc = state.desc;
    desc.visible = desc.visible && included(state);
    desc.asset = assetOf(state.path);
    _edit.setObject(id, std::move(desc));
}

void HdHiprRenderParam::setObject(hipr::ObjectId id, ObjectState const& state) {
    std::lock_guard<std::mutex> lock(_mutex);
    _objects[id] = state;
    emitObject(id, state);
}

void HdHiprRenderParam::removeObject(hipr::ObjectId id) {
    std::lock_guard<std::mutex> lock(_mutex);
    _objects.erase(id);
    _edit.removeObject(id);
}

void HdHiprRenderParam::updateRenderTags(HdRenderIndex const& index) {
    std::lock_guard<std::mutex> lock(_mutex);
    for (auto& [id, state] : _objects) {
        const TfToken tag = index.GetRenderTag(state.path);
        if (tag == state.renderTag) {
            continue;
        }
        state.renderTag = tag;
        emitObject(id, state);
    }
}

void HdHiprRenderParam::setLight(hipr::LightId id, hipr::LightDesc const& desc) {
    std::lock_guard<std::mutex> lock(_mutex);
    if (desc.kind == hipr::LightKind::Dome && desc.visible) {
        _domes.insert(id);
    } else {
        _domes.erase(id);
    }
    _edit.setLight(id, desc);
}

void HdHiprRenderParam::removeLight(hipr::LightId id) {
    std::lock_guard<std::mutex> lock(_mutex);
    _domes.erase(id);
    _edit.removeLight(id);
}

bool HdHiprRenderParam::setShutter(SdfPath const& camera, hipr::Shutter const& shutter) {
    std::lock_guard<std::mutex> lock(_mutex);
    const bool dropped = std::exchange(_shutterDropped, false);
    if (!shutter.blurs()) {
        return _openShutters.erase(camera) > 0 || dropped;
    }
    const auto [entry, added] = _openShutters.try_emplace(camera, shutter);
    const bool same = !added && entry->second == shutter;
    entry->second = shutter;
    return !same || dropped;
}

void HdHiprRenderParam::dropShutter(SdfPath const& camera) {
    std::lock_guard<std::mutex> lock(_mutex);
    _shutterDropped |= _openShutters.erase(camera) > 0;
}

hdhipr::Sampling HdHiprRenderParam::sampling() {
    std::lock_guard<std::mutex> lock(_mutex);
    hdhipr::Sampling sampling{{}, _framesPerSecond};
    for (auto const& [camera, shutter] : _openShutters) {
        hipr::Shutter& all = sampling.shutter;
        all = all.blurs()
                  ? hipr::Shutter{std::min(all.open, shutter.open), std::max(all.close, shutter.close)}
                  : shutter;
    }
    return sampling;
}

void HdHiprRenderParam::setFramesPerSecond(double framesPerSecond) {
    std::lock_guard<std::mutex> lock(_mutex);
    _rateChanged |= framesPerSecond != _framesPerSecond;
    _framesPerSecond = framesPerSecond;
}

bool HdHiprRenderParam::takeRateChange() {
    std::lock_guard<std::mutex> lock(_mutex);
    return std::exchange(_rateChanged, false) && !_openShutters.empty();
}

bool HdHiprRenderParam::hasDome() {
    std::lock_guard<std::mutex> lock(_mutex);
    return !_domes.empty();
}

void HdHiprRenderParam::setFilter(HdRprimCollection const& collection, TfTokenVector const& renderTags) {
    std::lock_guard<std::mutex> lock(_mutex);
    if (collection.GetRootPaths() == _rootPaths && collection.GetExcludePaths() == _excludePaths &&
        renderTags == _renderTags) {
        return;
    }
    std::vector<hipr::ObjectId> before;
    for (auto const& [id, state] : _objects) {
        if (included(state)) {
            before.push_back(id);
        }
    }
    std::sort(before.begin(), before.end());
    _rootPaths = collection.GetRootPaths();
    _excludePaths = collection.GetExcludePaths();
    _renderTags = renderTags;
    for (auto const& [id, state] : _objects) {
        const bool was = std::binary_search(before.begin(), before.end(), id);
        if (was != included(state)) {
            emitObject(id, state);
        }
    }
}

void HdHiprRenderParam::commitEdits() {
    if (_loop) {
        _loop->submitEdit(_edit);
    } else {
        _edit.clear();
    }
}

void HdHiprRenderParam::releaseBuffer(HdHiprRenderBuffer* buffer) {
    if (_loop) {
        _loop->releaseBuffer(buffer);
    }
}

PXR_NAMESPACE_CLOSE_SCOPE
