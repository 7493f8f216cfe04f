#include "renderer/trace/film.h"

#include <algorithm>
#include <cstring>

#include "renderer/hipr/tile_aovs.h"
#include "renderer/trace/cryptomatte.h"

namespace hipr {
namespace {

constexpr uint32_t MaxSide = 65535;        // PathState::pixel packs both coordinates
constexpr uint64_t MaxPixels = 1ull << 30; // kernels count the words of an AOV in 32 bits

bool isSum(AovKind kind) {
    return kind == AovKind::Color || kind == AovKind::Albedo || kind == AovKind::Variance ||
           kind == AovKind::Lpe || isCryptomatte(kind);
}

/// The word an AOV holds where nothing is seen.
uint32_t missWord(AovKind kind) {
    if (aovFormat(kind).integer) return uint32_t(-1);
    const float value = kind == AovKind::Depth ? 1.f : 0.f;
    uint32_t word;
    std::memcpy(&word, &value, sizeof(word));
    return word;
}

} // namespace

void FilmBuffers::setDesc(const FilmDesc& desc) {
    clear();
    _desc = desc;
    const bool fits =
        std::max(desc.width, desc.height) <= MaxSide && uint64_t(desc.width) * desc.height <= MaxPixels;
    if (!fits)
        return refuse("the limits are " + std::to_string(MaxSide) + " pixels a side and " +
                      std::to_string(MaxPixels) + " in all");
    _width = desc.width;
    _height = desc.height;
    try {
        if (pixels() > 0) allocate();
    } catch (const std::bad_alloc& e) {
        clear();
        refuse(reasonOf(e));
    }
}

void FilmBuffers::clear() {
    _width = _height = 0;
    _sums = {}, _oldPicture = {}, _firstSamples = {}, _visibility = {}, _previousHits = {}, _depths = {},
    _targets = {}, _spreads = {};
    _carried = {}, _seen = {}, _seenAfter = {}, _lists = {};
    _cryptomattes = {};
    _lightPaths.clear();
    _firstHits.clear();
    _hasPrevious = false;
}

/// A picture that cannot be had leaves a film without pixels; the host may ask for another.
void FilmBuffers::refuse(const std::string& reason) {
    _device.messages()(Severity::Error, "",
                       "a picture of " + std::to_string(_desc.width) + " x " + std::to_string(_desc.height) +
                           " is too large (" + reason + ")");
}

void FilmBuffers::allocate() {
    _sums = filled(pixels() * sizeof(gpu::FilmPixel), 0);
    createPictures();
    createSpreads();
    _firstSamples = _device.createBuffer(pixels() * sizeof(glm::vec3), MemoryUse::Device, "Film");
    _lightPaths.set(_desc.aovs, pixels());
    std::vector<gpu::AovTarget> targets;
    for (const AovRequest& request : _desc.aovs) {
        if (isCryptomatte(request.kind) && !_cryptomattes[cryptomatteIndex(request.kind)])
            _cryptomattes[cryptomatteIndex(request.kind)] =
                filled(pixels() * gpu::CRYPTOMATTE_RANKS * sizeof(gpu::CryptoEntry), 0);
        if (isSum(request.kind) || isTileAov(request.kind)) continue;
        const uint64_t bytes = pixels() * aovFormat(request.kind).components * sizeof(uint32_t);
        _firstHits.push_back({request, filled(bytes, missWord(request.kind))});
        const bool primvar = request.kind == AovKind::Primvar;
        targets.push_back({_firstHits.back().values.address(), uint32_t(request.kind),
                           primvar ? _names.intern(request.name) : gpu::NO_INDEX});
    }
    if (!targets.empty()) _targets = _device.createFrom(targets.data(), targets.size(), "Film");
    createHits();
}

void FilmBuffers::createHits() {
    const auto create = [&](Buffer& buffer, bool wanted, size_t stride) {
        if (!wanted || pixels() == 0)
            buffer = {};
        else if (!buffer)
            buffer = _device.createBuffer(pixels() * stride, MemoryUse::Device, "Film");
    };
    create(_visibility, wantsFirstHits(), sizeof(gpu::VisibilityRecord));
    create(_previousHits, _keepsHits, sizeof(gpu::VisibilityRecord));
    create(_depths, _keepsDepths, sizeof(float));
}

bool FilmBuffers::keepDepths(bool keep) {
    if (keep == _keepsDepths) return false;
    _keepsDepths = keep;
    createHits();
    return true;
}

void FilmBuffers::createPictures() {
    if (!_keepsPictures || pixels() == 0) {
        _oldPicture = {}, _carried = {}, _seen = {}, _seenAfter = {}, _lists = {};
        return;
    }
    const auto create = [&](size_t stride) {
        return _device.createBuffer(pixels() * stride, MemoryUse::Device, "Film");
    };
    _oldPicture = create(sizeof(gpu::OldPixel));
    _carried = create(sizeof(gpu::OldPixel));
    _seen = filled(pixels() * sizeof(gpu::SeenPoint), gpu::SEEN_NOTHING);
    _seenAfter = create(sizeof(gpu::SeenPoint));
    _lists = create(gpu::CARRIED_LISTS * sizeof(uint32_t));
}

void FilmBuffers::createSpreads() {
    const bool wanted = pixels() > 0 && (_keepsSpreads || holds({AovKind::Variance, {}}));
    if (!wanted)
        _spreads = {};
    else if (!_spreads)
        _spreads = filled(pixels() * sizeof(glm::vec3), 0);
}

void FilmBuffers::keepSpreads(bool keep) {
    if (keep == _keepsSpreads) return;
    _keepsSpreads = keep;
    createSpreads();
}

void FilmBuffers::keepPictures(bool keep) {
    if (keep == _keepsPictures) return;
    _keepsPictures = keep;
    createPictures();
}

bool FilmBuffers::carry(Reprojection& reprojection, const TileSchedule& schedule,
                        const gpu::CameraRecord& before, const gpu::CameraRecord& after,
                        std::vector<gpu::CarriedStrip>& strips) {
    if (!_seen) return false;
    if (!reprojection.carry({_sums, _oldPicture, _carried, _seen, _seenAfter, _lists, depths()}, schedule,
                            before, after, strips))
        return false;
    _seen.swap(_seenAfter);
    _oldPicture.swap(_carried);
    return true;
}

bool FilmBuffers::keepHits(bool keep) {
    if (keep == _keepsHits) return false;
    _keepsHits = keep;
    _hasPrevious = false;
    createHits();
    return true;
}

void FilmBuffers::retireHits() {
    if (!_keepsHits) return;
    _visibility.swap(_previousHits);
    _hasPrevious = true;
}

Buffer FilmBuffers::filled(uint64_t bytes, uint32_t word) {
    Buffer buffer = _device.createBuffer(bytes, MemoryUse::Device, "Film");
    _device.run([&](VkCommandBuffer cmd) { vkCmdFillBuffer(cmd, buffer.handle(), 0, VK_WHOLE_SIZE, word); });
    return buffer;
}

void FilmBuffers::describe(gpu::TraceRecord& record) const {
    record.film = _sums ? _sums.address() : 0;
    record.oldPicture = _oldPicture ? _oldPicture.address() : 0;
    record.firstSamples = _firstSamples ? _firstSamples.address() : 0;
    record.spreads = _spreads ? _spreads.address() : 0;
    record.seen = _seen ? _seen.address() : 0;
    record.visibility = _visibility ? _visibility.address() : 0;
    record.opaqueDepths = depths();
    record.aovs = _targets ? _targets.address() : 0;
    record.aovCount = uint32_t(_firstHits.size());
    for (size_t kind = 0; kind < _cryptomattes.size(); ++kind)
        record.cryptomattes[kind] = _cryptomattes[kind] ? _cryptomattes[kind].address() : 0;
    record.width = _width;
    record.height = _height;
}

bool FilmBuffers::holds(const AovRequest& aov) const {
    return std::find(_desc.aovs.begin(), _desc.aovs.end(), aov) != _desc.aovs.end();
}

bool FilmBuffers::wantsNames() const {
    return std::any_of(_desc.aovs.begin(), _desc.aovs.end(), [](const AovRequest& aov) {
        return aov.kind == AovKind::Lpe || isCryptomatte(aov.kind);
    });
}

bool FilmBuffers::read(const AovRequest& aov, const TileSchedule& schedule, void* dst, size_t words) const {
    if (!holds(aov)) return false;
    if (words != pixels() * aovFormat(aov.kind).components) return false;
    if (words == 0) return true;
    if (aov.kind == AovKind::Color)
        readMeans(&gpu::FilmPixel::color, &gpu::OldPixel::color, schedule, static_cast<float*>(dst));
    if (aov.kind == AovKind::Albedo)
        readMeans(&gpu::FilmPixel::albedo, &gpu::OldPixel::albedo, schedule, static_cast<float*>(dst));
    if (aov.kind == AovKind::Variance) readVariance(static_cast<float*>(dst));
    if (aov.kind == AovKind::Lpe) readLightPath(aov.name, static_cast<float*>(dst));
    if (isCryptomatte(aov.kind)) readCryptomatte(aov, static_cast<float*>(dst));
    for (const FirstHitAov& firstHit : _firstHits)
        if (firstHit.request == aov) _device.download(firstHit.values, dst, words * sizeof(uint32_t));
    return true;
}

/// The buffer's content where the host can read it.
template <class T> const T* FilmBuffers::hostCopy(const Buffer& buffer, std::vector<T>& copy) const {
    if (const T* mapped = buffer.mapped<T>()) return mapped;
    copy.resize(buffer.bytes() / sizeof(T));
    _device.download(buffer, copy.data(), copy.size() * sizeof(T));
    return copy.data();
}

/// Of the samples of the current scene, whatever is on display.
void FilmBuffers::readVariance(float* dst) const {
    std::vector<gpu::FilmPixel> sumCopy;
    const gpu::FilmPixel* sums = hostCopy(_sums, sumCopy);
    _device.download(_spreads, dst, pixels() * sizeof(glm::vec3));
    for (size_t i = 0; i < pixels(); ++i, dst += 3) {
        const float n = float(sums[i].count), weight = n > 1.f ? 1.f / (n * (n - 1.f)) : 0.f;
        for (int c = 0; c < 3; ++c)
            dst[c] *= weight;
    }
}

void FilmBuffers::readLightPath(const std::string& expression, float* dst) const {
    std::vector<gpu::FilmPixel> sumCopy;
    _lightPaths.read(expression, hostCopy(_sums, sumCopy), pixels(), dst);
}

/// Of the samples of the current scene, once there are any.
void FilmBuffers::readCryptomatte(const AovRequest& aov, float* dst) const {
    std::vector<gpu::FilmPixel> sumCopy;
    std::vector<gpu::CryptoEntry> entryCopy;
    const gpu::FilmPixel* sums = hostCopy(_sums, sumCopy);
    const gpu::CryptoEntry* entries = hostCopy(_cryptomattes[cryptomatteIndex(aov.kind)], entryCopy);
    for (size_t i = 0; i < pixels(); ++i, entries += gpu::CRYPTOMATTE_RANKS, dst += 4) {
        const CryptoRanks ranks = cryptoRanks(entries);
        for (uint32_t k = 0; k < 2; ++k) {
            const gpu::CryptoEntry& entry = ranks[2 * aov.layer + k];
            dst[2 * k] = entry.id;
            dst[2 * k + 1] = float(entry.count) / float(std::max(sums[i].count, 1u));
        }
    }
}

/// What is on display, of one member of the pixels.
template <class Value>
void FilmBuffers::readMeans(Value gpu::FilmPixel::*sum, Value gpu::OldPixel::*old,
                            const TileSchedule& schedule, float* dst) const {
    std::vector<gpu::FilmPixel> sumCopy;
    std::vector<gpu::OldPixel> oldCopy;
    const gpu::FilmPixel* sums = hostCopy(_sums, sumCopy);
    const gpu::OldPixel* olds = nullptr; // few pictures need it
    const TileGrid& grid = schedule.grid();
    for (uint32_t tile = 0; tile < grid.count(); ++tile) {
        const bool keepsOld = schedule.tiles()[tile].keepsOld;
        if (keepsOld && !olds) olds = hostCopy(_oldPicture, oldCopy);
        const TileRect r = grid.rect(tile);
        for (uint32_t y = r.y; y < r.y + r.height; ++y)
            for (size_t i = size_t(y) * grid.width + r.x, end = i + r.width; i < end; ++i) {
                const float weight = sums[i].count ? 1.f / float(sums[i].count) : 0.f;
                const Value mean = keepsOld ? olds[i].*old : sums[i].*sum * weight;
                std::memcpy(dst + i * Value::length(), &mean, sizeof(mean));
            }
    }
}

} // namespace hipr
