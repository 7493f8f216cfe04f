#include "renderer/higs/splat_frame.h"

#include <array>
#include <cmath>
#include <limits>

namespace hipr {
namespace {

glm::dvec4 row(const glm::dmat4& m, int r) {
    return {m[0][r], m[1][r], m[2][r], m[3][r]};
}

glm::dmat4 extended(const glm::mat4x3& m) {
    glm::dmat4 r(1.0);
    for (int c = 0; c < 4; ++c)
        r[c] = glm::dvec4(glm::dvec3(m[c]), c == 3 ? 1.0 : 0.0);
    return r;
}

bool finite(const glm::dmat4& m) {
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r)
            if (!std::isfinite(m[c][r])) return false;
    return true;
}

struct Interval {
    float lo = std::numeric_limits<float>::max(), hi = std::numeric_limits<float>::lowest();
    void add(float v) {
        lo = std::min(lo, v);
        hi = std::max(hi, v);
    }
};

std::array<glm::vec4, 8> cornersOf(const SplatBounds& b) {
    std::array<glm::vec4, 8> corners;
    for (int i = 0; i < 8; ++i)
        corners[i] = {i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z, 1.f};
    return corners;
}

/// What projectTangentially() in project.comp does to a standard deviation and to a centre at most, the
/// latter in standard deviations.
const float MostTangentStretch = 1.f / (1.f - gpu::SPLAT_TANGENT_LIMIT);
const float MostTangentShift =
    std::sqrt(gpu::SPLAT_TANGENT_CONTOUR * gpu::SPLAT_TANGENT_LIMIT) * MostTangentStretch;

/// Whether splats may reach from `lo` to `hi` along one side of the picture, of `size` pixels. `pixel`: the
/// placement's pixelX or pixelY; `leastW`: of all centres, positive. A splat's reach there is that of
/// projectShape() in project.comp, whose gradient is bounded by those at the ends of where it is taken.
bool meets(const glm::vec4& pixel, const gpu::SplatPlacement& p, const SplatBounds& bounds, float leastW,
           bool limited, float size, float lo, float hi) {
    Interval mean;
    for (const glm::vec4& corner : cornersOf(bounds))
        mean.add(glm::dot(pixel, corner) / glm::dot(p.clipW, corner));
    Interval at = mean;
    if (limited) {
        at.lo = glm::clamp(mean.lo, -0.15f * size, 1.15f * size);
        at.hi = glm::clamp(mean.hi, -0.15f * size, 1.15f * size);
    }
    const auto gradient = [&](float x) { return glm::length(glm::vec3(pixel) - x * glm::vec3(p.clipW)); };
    float deviation = bounds.deviation * std::max(gradient(at.lo), gradient(at.hi)) / leastW;
    const float shift = limited ? 0.f : MostTangentShift * deviation;
    if (!limited) deviation *= MostTangentStretch;
    const float reach =
        1.01f * (gpu::SPLAT_MAX_EXTENT * std::sqrt(deviation * deviation + gpu::SPLAT_DILATION) + shift) +
        1.f;
    return !(mean.hi + reach < lo || mean.lo - reach > hi); // true as well where it is not a number
}

} // namespace

glm::uvec2 binSize(SplatMode mode) {
    switch (mode) {
    case SplatMode::Flat16Aabb:
    case SplatMode::Flat16Exact:
        return {16, 16};
    case SplatMode::Flat8Exact:
        return {8, 8};
    default:
        return {gpu::SPLAT_MACRO_WIDTH, gpu::SPLAT_MACRO_HEIGHT};
    }
}

bool isFlat(SplatMode mode) {
    return mode == SplatMode::Flat16Aabb || mode == SplatMode::Flat16Exact || mode == SplatMode::Flat8Exact;
}

gpu::SplatPlacement splatPlacement(const SplatInstance& instance, const SplatView& view, uint32_t first) {
    const gpu::CameraRecord& camera = view.camera;
    const glm::dmat4 toWorld = extended(instance.objectToWorld), toObject = glm::inverse(toWorld);
    const glm::dmat4 clip = glm::dmat4(camera.worldToClip) * toWorld;
    const glm::dvec3 forward(camera.forward);

    gpu::SplatPlacement p{};
    p.arrays = instance.store->arrays();
    p.pixelX = 0.5 * view.width * (row(clip, 0) + row(clip, 3));
    p.pixelY = 0.5 * view.height * (row(clip, 1) + row(clip, 3));
    p.clipW = row(clip, 3);
    p.depth = glm::dvec4(forward, -glm::dot(forward, glm::dvec3(camera.origin))) * toWorld;
    p.eye = toObject * glm::dvec4(glm::dvec3(camera.origin), 1.0);
    p.direction = toObject * glm::dvec4(glm::dvec3(camera.direction), 0.0);
    p.toWorldX = instance.objectToWorld[0];
    p.toWorldY = instance.objectToWorld[1];
    p.toWorldZ = instance.objectToWorld[2];
    p.first = first;
    p.primId = instance.primId;
    p.instanceId = instance.instanceId;
    const bool usable = finite(toWorld) && finite(toObject);
    p.flags = (instance.visible && usable ? 0u : gpu::SPLATS_HIDDEN) |
              (instance.store->projection() == SplatProjection::Tangential ? gpu::SPLATS_TANGENTIAL : 0u);
    return p;
}

bool mayShow(const SplatInstance& instance, const SplatView& view) {
    const SplatBounds& bounds = instance.store->bounds();
    const gpu::SplatPlacement p = splatPlacement(instance, view, 0);
    if (bounds.lo.x > bounds.hi.x || (p.flags & gpu::SPLATS_HIDDEN)) return false;
    Interval depth, w;
    for (const glm::vec4& corner : cornersOf(bounds)) {
        depth.add(glm::dot(p.depth, corner));
        w.add(glm::dot(p.clipW, corner));
    }
    const float slack = 1e-4f * (std::abs(depth.lo) + std::abs(depth.hi)); // of the kernel's own rounding
    if (depth.hi + slack < view.camera.nearDepth || depth.lo - slack > view.camera.farDepth) return false;
    if (!(w.lo > 0.f)) return true; // some centres are beside the camera: they may be seen anywhere
    const float width = float(view.width), height = float(view.height);
    const bool limited = !(p.flags & gpu::SPLATS_TANGENTIAL);
    return meets(p.pixelX, p, bounds, w.lo, limited, width, float(view.cropX),
                 view.cropWidth ? float(view.cropX + view.cropWidth) : width) &&
           meets(p.pixelY, p, bounds, w.lo, limited, height, float(view.cropY),
                 view.cropHeight ? float(view.cropY + view.cropHeight) : height);
}

SplatBlocks splatBlocks(const std::vector<size_t>& sizes) {
    SplatBlocks all;
    uint64_t splats = 0;
    for (const size_t size : sizes) {
        all.firstBlock.push_back(uint32_t(all.blocks.size()));
        all.firstSplat.push_back(uint32_t(splats));
        for (size_t first = 0; first < size; first += gpu::SPLAT_BLOCK)
            all.blocks.push_back({uint32_t(all.firstBlock.size() - 1), uint32_t(first)});
        splats += size;
    }
    if (splats >= gpu::NO_SPLAT) throw OutOfMemory("there are more than 4294967294 splats");
    all.firstBlock.push_back(uint32_t(all.blocks.size()));
    all.firstSplat.push_back(uint32_t(splats));
    return all;
}

uint64_t SplatBuffers::histogramBytes(const gpu::SplatFrame& f) const {
    const uint64_t tileCount = uint64_t(f.tileColumns) * f.tileRows;
    const uint64_t counters = _lanes ? tileCount * gpu::SPLAT_CHUNKS : tileCount;
    return sizeof(uint32_t) * std::max<uint64_t>(counters, gpu::SPLAT_CHUNKS * gpu::SPLAT_DIGITS);
}

void SplatBuffers::reserveLists(uint64_t pairCount, uint64_t batchCount) {
    _pairCapacity = std::max(_pairCapacity, pairCount);
    _batchCapacity = std::max(_batchCapacity, batchCount);
}

void SplatBuffers::prepareLists(SplatMode mode, gpu::SplatFrame& f) {
    if (_pairCapacity == 0) { // a guess; frames that need more make it grow
        const uint64_t tileCount = uint64_t(f.tileColumns) * f.tileRows;
        reserveLists(f.splatCount / 2 + 32 * tileCount + 4096, f.splatCount / 1024 + tileCount + 64);
    }
    for (int side = 0; side < 2; ++side)
        if (isFlat(mode)) {
            tilePairs[side].reserve(_device, _pairCapacity * sizeof(gpu::SplatTilePair));
            f.tilePairs[side] = tilePairs[side].address();
        } else {
            pairs[side].reserve(_device, _pairCapacity * sizeof(gpu::SplatPair));
            f.pairs[side] = pairs[side].address();
        }
    if (!isFlat(mode)) {
        masks.reserve(_device, _pairCapacity * sizeof(uint32_t));
        f.masks = masks.address();
    }
    if (mode == SplatMode::Higs8) {
        constexpr uint64_t Pixels = gpu::SPLAT_MACRO_WIDTH * gpu::SPLAT_MACRO_HEIGHT;
        partials.reserve(_device, _batchCapacity * Pixels * sizeof(gpu::SplatPartial));
        f.partials = partials.address();
    }
    f.pairCapacity = uint32_t(std::min<uint64_t>(_pairCapacity, UINT32_MAX));
    f.batchCapacity = uint32_t(std::min<uint64_t>(_batchCapacity, UINT32_MAX));
}

void SplatBuffers::prepare(SplatMode mode, gpu::SplatFrame& f) {
    const uint64_t tileCount = uint64_t(f.tileColumns) * f.tileRows;
    const auto reserve = [&](GrowingBuffer& buffer, uint64_t bytes) {
        buffer.reserve(_device, bytes);
        return buffer.address();
    };
    const bool sortedByRay = SplatSorting(f.sorting) == SplatSorting::RayHitDistance;
    const uint64_t splatBytes = _half ? sizeof(gpu::ProjectedSplatHalf) : sizeof(gpu::ProjectedSplat);
    f.placements = reserve(placements, f.placementCount * sizeof(gpu::SplatPlacement));
    f.blocks = blocks.address();
    f.splats = reserve(splats, f.splatCount * splatBytes);
    f.reaches = reserve(reaches, f.splatCount * sizeof(gpu::SplatReach));
    f.rays = sortedByRay ? reserve(rays, f.splatCount * sizeof(gpu::SplatRay)) : 0;
    f.histogram = reserve(histogram, histogramBytes(f));
    f.tiles = reserve(tiles, tileCount * sizeof(gpu::SplatTile));
    f.tileMask = reserve(tileMask, tileCount * sizeof(uint32_t));
    f.pixels = reserve(pixels, uint64_t(f.width) * f.height * sizeof(gpu::SplatPixel));
    const uint64_t renderTiles = uint64_t((f.width + 7) / 8) * ((f.height + 7) / 8);
    f.emptied = reserve(emptied, renderTiles * sizeof(uint32_t));
    f.state = reserve(state, sizeof(gpu::SplatState));
    f.camera = reserve(camera, sizeof(gpu::CameraRecord));
    f.blends = f.flags & gpu::FRAME_PROFILING ? reserve(blends, tileCount * sizeof(glm::uvec2)) : 0;
    reserve(frame, sizeof(gpu::SplatFrame));
    prepareLists(mode, f);
}

} // namespace hipr
