#include "renderer/trace/splat_layer.h"

#include <algorithm>

#include "renderer/higs/splat_frame.h"

namespace hipr {
namespace {

/// The mode of a setting's value; names are those of splatModeName().
SplatMode splatMode(const std::string& name) {
    for (const SplatMode mode : {SplatMode::Flat16Aabb, SplatMode::Flat16Exact, SplatMode::Flat8Exact,
                                 SplatMode::Higs8, SplatMode::Higs8Carry})
        if (name == splatModeName(mode)) return mode;
    return SplatMode::Automatic;
}

/// A point that the pixel's centre shows, at a camera depth.
glm::vec3 pointAt(const gpu::CameraRecord& camera, glm::vec2 ndc, float depth) {
    const glm::vec3 direction = camera.direction + ndc.x * camera.directionX + ndc.y * camera.directionY;
    return camera.origin + ndc.x * camera.originX + ndc.y * camera.originY +
           direction * (depth / glm::dot(direction, camera.forward));
}

} // namespace

void SplatLayer::updateStores(const SplatTable& table) {
    for (auto it = _stores.begin(); it != _stores.end();) {
        const SplatSet* set = table.find(it->first);
        it = set && set->revision == it->second.revision ? std::next(it) : _stores.erase(it);
    }
}

void SplatLayer::setScene(const SplatTable& table, const std::vector<SplatPlacement>& placements) {
    _failed = false;
    updateStores(table);
    std::vector<SplatInstance> instances;
    std::vector<SplatMotion::Placed> placed;
    for (const SplatPlacement& placement : placements) {
        const SplatSet& set = *table.find(placement.splats);
        Stored& stored = _stores[placement.splats];
        if (stored.revision != set.revision) {
            stored.revision = set.revision;
            try {
                stored.store = std::make_shared<SplatStore>(_device, *set.cloud);
            } catch (const OutOfMemory& e) {
                _device.messages()(Severity::Error, set.cloud->name,
                                   std::string(e.what()) + "; its splats are not drawn");
            }
        }
        if (!stored.store || stored.store->size() == 0) continue;
        instances.push_back({stored.store, placement.objectToWorld, placement.primId, placement.instanceId});
        placed.push_back({placement.objectToWorld, placement.keys, set.box});
    }
    const bool same = std::equal(instances.begin(), instances.end(), _instances.begin(), _instances.end(),
                                 [](const SplatInstance& a, const SplatInstance& b) {
                                     return a.store == b.store && a.objectToWorld == b.objectToWorld &&
                                            a.primId == b.primId && a.instanceId == b.instanceId;
                                 });
    const bool otherMotion = _motion.setInstances(std::move(placed));
    if (same && !otherMotion) return;
    _instances = std::move(instances);
    _pending = true;
    if (_instances.empty()) _drawn = false;
    if (_ready) _pass->setInstances(_instances);
}

void SplatLayer::setView(const gpu::CameraRecord& camera, uint32_t width, uint32_t height) {
    const bool sameFilm = width == _view.width && height == _view.height;
    _drawn &= sameFilm; // what is drawn does not fit another film
    _failed &= sameFilm;
    _view.camera = camera;
    _view.width = width;
    _view.height = height;
    _pending = true;
    if (_ready) _pass->setView(_view);
}

void SplatLayer::setMotion(const CameraDesc& camera, const Shutter& shutter) {
    if (_motion.setCamera(camera, _view.camera, shutter)) _pending = true;
}

void SplatLayer::setSettings(const Settings& settings) {
    const SplatMode mode = splatMode(settings.splatMode);
    const bool srgb = settings.splatColors == "sRGB";
    if (mode == _mode && settings.splatAntialiasing == _view.antialiased && srgb == _view.srgb) return;
    _mode = mode;
    _view.srgb = srgb;
    _view.antialiased = settings.splatAntialiasing;
    _pending = true;
    if (!_ready) return;
    _pass->setMode(_mode);
    _pass->setView(_view);
}

void SplatLayer::setDepths(VkDeviceAddress cameraDepths) {
    if (cameraDepths == 0 && _depths == 0) return;
    _depths = cameraDepths;
    _pending = true;
    if (_ready) _pass->setDepthLimit(cameraDepths);
}

SplatLayer::~SplatLayer() {
    if (_compiling.valid()) _compiling.wait();
    if (_ready) _pass->setInstances({});
}

bool SplatLayer::ready(std::chrono::milliseconds patience) {
    if (_ready) return true;
    if (!_pass) {
        if (!_compiling.valid())
            _compiling =
                std::async(std::launch::async, [this] { return std::make_unique<SplatPass>(_device); });
        if (_compiling.wait_for(patience) != std::future_status::ready) return false;
        _pass = _compiling.get();
    }
    prepare();
    return true;
}

void SplatLayer::prepare() {
    _ready = true;
    _elsewhere = false;
    _pass->setMode(_mode);
    _pass->setView(_view);
    _pass->setInstances(_instances);
    _pass->setDepthLimit(_depths);
}

bool SplatLayer::render(const std::atomic<bool>& cancel) {
    try {
        if (!(_pending ? drawFrame(cancel) : drawMoment(cancel))) return false;
        _drawn = true;
    } catch (const std::bad_alloc& e) {
        fail(reasonOf(e));
    }
    _pending = false;
    return true;
}

/// The pass may have been left with another moment, when what it drew was no longer wanted.
bool SplatLayer::drawFrame(const std::atomic<bool>& cancel) {
    if (_elsewhere) prepare();
    if (!_pass->render(&cancel)) return false;
    _moments = _motion.moments(_view.width, _view.height);
    _momentsDrawn = 0;
    _mean.clear();
    _shown = fetch();
    if (_moments > 0) { // which the pass draws in the same place
        _frame.assign(_shown, _shown + pixelCount());
        _shown = _frame.data();
    }
    return true;
}

bool SplatLayer::drawMoment(const std::atomic<bool>& cancel) {
    _elsewhere = true;
    const float time = SplatMotion::timeOf(_momentsDrawn, _moments);
    for (uint32_t i = 0; i < _instances.size(); ++i)
        _pass->place(i, _motion.placement(i, time));
    if (_motion.cameraMoves()) {
        SplatView view = _view;
        view.camera = _motion.camera(time);
        _pass->setView(view);
    }
    if (!_pass->render(&cancel)) return false;
    _mean.add(fetch(), pixelCount());
    if (++_momentsDrawn == _moments) prepare();
    return true;
}

/// What the pass drew, readable by the host. It is copied only where the host cannot read device memory, and
/// then only the rows between which something was drawn.
const gpu::SplatPixel* SplatLayer::fetch() {
    if (const auto* mapped = _pass->pixels().mapped<gpu::SplatPixel>()) return mapped;
    const size_t width = _view.width, pixels = width * _view.height;
    const std::vector<uint32_t>& tiles = _pass->drawnTiles();
    const auto drawn = [](uint32_t tile) { return tile != 0; };
    size_t first = size_t(std::find_if(tiles.begin(), tiles.end(), drawn) - tiles.begin());
    size_t end = size_t(tiles.rend() - std::find_if(tiles.rbegin(), tiles.rend(), drawn));
    if (_pixels.size() == pixels) {
        const size_t columns = _pass->tileColumns(), rowPixels = width * binSize(_pass->mode()).y;
        first = std::min(first / columns * rowPixels, pixels);
        end = std::min((end + columns - 1) / columns * rowPixels, pixels);
    } else {
        _pixels.resize(pixels);
        first = 0, end = pixels;
    }
    constexpr uint64_t Stride = sizeof(gpu::SplatPixel);
    if (first < end)
        _device.download(_pass->pixels(), &_pixels[first], (end - first) * Stride, first * Stride);
    return _pixels.data();
}

void SplatLayer::fail(const char* reason) {
    _failed = true;
    _drawn = false;
    _device.messages()(Severity::Error, "", std::string(reason) + "; the picture is drawn without splats");
}

void SplatLayer::blend(const AovRequest& aov, void* values, uint64_t pixels) const {
    if (!_drawn || pixelCount() != pixels) return;
    const auto replace = [&](auto word) {
        for (size_t i = 0; i < pixels; ++i)
            if (_shown[i].splat != gpu::NO_SPLAT) word(_shown[i], i);
    };
    int* ints = static_cast<int*>(values);
    glm::vec3* vectors = static_cast<glm::vec3*>(values);
    switch (aov.kind) {
    case AovKind::Color:
        return blendColor(static_cast<float*>(values));
    case AovKind::Albedo:
        return blendAlbedo(static_cast<float*>(values));
    case AovKind::Depth:
    case AovKind::CameraDepth:
        return blendDepth(aov.kind, static_cast<float*>(values));
    case AovKind::PrimId:
        return replace([&](const gpu::SplatPixel& pixel, size_t i) { ints[i] = pixel.primId; });
    case AovKind::InstanceId:
        return replace([&](const gpu::SplatPixel& pixel, size_t i) { ints[i] = pixel.instanceId; });
    case AovKind::ElementId:
        return replace([&](const gpu::SplatPixel& pixel, size_t i) { ints[i] = int(pixel.splat); });
    case AovKind::Peye:
        return blendPositions(vectors);
    case AovKind::Normal:
    case AovKind::Neye:
    case AovKind::PatchCoord:
    case AovKind::Primvar: // splats have none
        return replace([&](const gpu::SplatPixel&, size_t i) { vectors[i] = glm::vec3(0.f); });
    default:
        return; // of HiPR's tiles, or of samples, of which splats have none
    }
}

glm::vec3 SplatLayer::shownPoint(size_t pixel) const {
    const glm::vec2 film = glm::vec2(pixel % _view.width, pixel / _view.width) + 0.5f;
    const glm::vec2 ndc = 2.f * film / glm::vec2(_view.width, _view.height) - 1.f;
    return pointAt(_view.camera, ndc, _shown[pixel].depth);
}

void SplatLayer::blendPositions(glm::vec3* positions) const {
    for (size_t i = 0; i < pixelCount(); ++i)
        if (_shown[i].splat != gpu::NO_SPLAT)
            positions[i] = _view.camera.worldToView * glm::vec4(shownPoint(i), 1.f);
}

glm::vec4 SplatLayer::shownColor(size_t pixel) const {
    if (_moments > 0 && _momentsDrawn == _moments) return _mean.at(pixel);
    return {_shown[pixel].color, _shown[pixel].transmittance};
}

void SplatLayer::blendColor(float* rgba) const {
    for (size_t i = 0; i < pixelCount(); ++i, rgba += 4) {
        const glm::vec4 splats = shownColor(i);
        for (int c = 0; c < 3; ++c)
            rgba[c] = splats[c] + splats.w * rgba[c];
        rgba[3] = 1.f - splats.w * (1.f - rgba[3]);
    }
}

void SplatLayer::blendAlbedo(float* rgb) const {
    for (size_t i = 0; i < pixelCount(); ++i, rgb += 3) {
        const glm::vec4 splats = shownColor(i);
        for (int c = 0; c < 3; ++c)
            rgb[c] = splats[c] + splats.w * rgb[c];
    }
}

void SplatLayer::blendDepth(AovKind kind, float* depths) const {
    for (size_t i = 0; i < pixelCount(); ++i) {
        if (_shown[i].splat == gpu::NO_SPLAT) continue;
        const glm::vec4 point(shownPoint(i), 1.f);
        if (kind == AovKind::CameraDepth) {
            depths[i] = -(_view.camera.worldToView * point).z;
        } else {
            const glm::vec4 clip = _view.camera.worldToClip * point;
            depths[i] = glm::clamp(0.5f * clip.z / clip.w + 0.5f, 0.f, 1.f);
        }
    }
}

uint64_t SplatLayer::bytes() const {
    uint64_t bytes = 0;
    for (const auto& [id, stored] : _stores)
        bytes += stored.store ? stored.store->bytes() : 0;
    return bytes;
}

} // namespace hipr
