#include "renderer/trace/path_tracer.h"

#include <algorithm>

#include "renderer/scene/motion.h"

namespace hipr {
namespace {

/// Rounds recorded before the host looks whether any path is left, when the traversal runs on the device.
constexpr uint32_t RoundsPerLook = 8;
/// The same for the steps of shadow rays through transparent surfaces.
constexpr uint32_t StepsPerLook = 16;
/// Every device takes 65,535 workgroups.
constexpr uint32_t PixelsPerDispatch = 65535 * gpu::TRACE_GROUP_SIZE;

constexpr uint32_t bit(uint32_t queue) {
    return 1u << queue;
}
constexpr uint32_t AllQueues = (1u << gpu::QUEUE_COUNT) - 1;

uint32_t groupsOf(uint32_t invocations) {
    return (invocations + gpu::TRACE_GROUP_SIZE - 1) / gpu::TRACE_GROUP_SIZE;
}

} // namespace

PathTracer::PathTracer(Device& device, uint32_t capacity)
    : _device(device), _kernels(device, traceKernelSources()), _buffers(device, capacity),
      _record(device.createBuffer(sizeof(gpu::TraceRecord), MemoryUse::Device, "Path queues")),
      _camera(device.createBuffer(sizeof(gpu::CameraRecord), MemoryUse::Device, "Path queues")),
      _cameraKeys(
          device.createBuffer(MaxMotionKeys * sizeof(glm::mat4x3), MemoryUse::Device, "Path queues")) {}

void PathTracer::prepareFor(uint32_t sceneFlags) {
    const uint32_t features = sceneFlags & gpu::SCENE_SHADING_FEATURES;
    std::unique_ptr<BackgroundKernels>& shading = _shadingVariants[features];
    if (!shading) shading = std::make_unique<BackgroundKernels>(_device, shadingKernelSources(features));
    if ((sceneFlags & gpu::SCENE_HAS_VOLUMES) && !_volumeKernels)
        _volumeKernels = std::make_unique<BackgroundKernels>(_device, volumeKernelSources());
}

void PathTracer::setup(gpu::TraceRecord record, const gpu::LpeRecord& lpe, const gpu::CameraRecord& camera,
                       const std::vector<glm::mat4x3>& cameraKeys, uint32_t sceneFlags) {
    _buffers.describe(record);
    record.camera = _camera.address();
    record.cameraKeys = _cameraKeys.address();
    record.cameraKeyCount = uint32_t(cameraKeys.size());
    if (!cameraKeys.empty())
        _device.upload(_cameraKeys, cameraKeys.data(), cameraKeys.size() * sizeof(glm::mat4x3));
    _scene = record.scene;
    _sceneFlags = sceneFlags;
    prepareFor(sceneFlags);
    _shading = _shadingVariants.at(sceneFlags & gpu::SCENE_SHADING_FEATURES).get();
    _countsNames = std::any_of(std::begin(record.cryptomattes), std::end(record.cryptomattes),
                               [](uint64_t address) { return address != 0; });
    _sortsLight = lpe.count > 0;
    if ((_countsNames || _sortsLight) && !_filmKernels)
        _filmKernels = std::make_unique<BackgroundKernels>(_device, filmKernelSources());
    _buffers.keepSlots(_device, _countsNames);
    _buffers.sortLight(_device, lpe);
    record.pathSlots = _countsNames ? _buffers.slots.address() : 0;
    record.lpe = _sortsLight ? _buffers.lpe.address() : 0;
    _device.upload(_record, &record, sizeof(record));
    _device.upload(_camera, &camera, sizeof(camera));
}

/// Sizes the dispatches of the queues in `close` and empties those in `clear`. Where the host traces next it
/// has to wait for the kernels anyway, and does this itself: a dispatch takes longer than the work.
void PathTracer::prepare(Steps& steps, uint32_t close, uint32_t clear) {
    if (steps.onHost()) {
        steps.flush();
        return prepareOnHost(close, clear);
    }
    gpu::TraceKernelPush p = push();
    p.first = close | clear << 8;
    steps.run("prepare", [this, p](VkCommandBuffer cmd) { kernel(KernelId::Prepare).dispatch(cmd, &p, 1); });
}

void PathTracer::prepareOnHost(uint32_t close, uint32_t clear) {
    auto* headers = _buffers.headers.mapped<gpu::QueueHeader>();
    auto* counters = _buffers.counters.mapped<gpu::TraceCounters>();
    for (uint32_t queue = 0; queue < gpu::QUEUE_COUNT; ++queue) {
        if (clear & bit(queue)) headers[queue] = gpu::queueHeader(0);
        if (!(close & bit(queue))) continue;
        headers[queue] = gpu::queueHeader(headers[queue].count);
        counters->rays[queue / 2] += headers[queue].count;
    }
}

void PathTracer::dispatchQueue(Steps& steps, const char* name, const Kernel& kernel, uint32_t queue,
                               uint32_t turn, uint32_t first) {
    gpu::TraceKernelPush p = push();
    p.turn = turn;
    p.first = first;
    steps.run(name, [this, p, &kernel, queue](VkCommandBuffer cmd) {
        kernel.dispatchIndirect(cmd, &p, _buffers.headers,
                                WavefrontBuffers::headerOffset(queue) + offsetof(gpu::QueueHeader, groupsX));
    });
}

void PathTracer::discover(Steps& steps, const char* name, const Discovering& discovery, DiscoveryKernelId id,
                          uint32_t queue, uint32_t turn) {
    if (discovery.passes)
        dispatchQueue(steps, name, discovery.passes->kernel(id), queue + turn, turn, discovery.scouts);
}

void PathTracer::passVolumes(Steps& steps, const char* name, VolumeKernelId id, uint32_t queue,
                             uint32_t turn) {
    if (_sceneFlags & gpu::SCENE_HAS_VOLUMES)
        dispatchQueue(steps, name, _volumeKernels->get(size_t(id)), queue + turn, turn);
}

uint32_t PathTracer::queueCount(uint32_t queue) {
    gpu::QueueHeader header;
    _device.download(_buffers.headers, &header, sizeof(header), WavefrontBuffers::headerOffset(queue));
    return header.count;
}

void PathTracer::raygen(Steps& steps, const std::vector<gpu::TileWork>& tiles, uint32_t paths) {
    uint32_t slots = 0; // of the largest tile
    for (const gpu::TileWork& tile : tiles)
        slots = std::max(slots, tile.width * tile.height * tile.sampleCount);
    gpu::TraceKernelPush p = push();
    p.count = paths;
    steps.run("raygen", [this, p, slots, count = uint32_t(tiles.size())](VkCommandBuffer cmd) {
        kernel(KernelId::Raygen).dispatch(cmd, &p, groupsOf(slots), count);
    });
    prepare(steps, bit(gpu::QUEUE_RAYS), AllQueues & ~bit(gpu::QUEUE_RAYS));
}

/// Adds the light of shadow rays that arrive.
void PathTracer::resolveShadows(Steps& steps, uint32_t turn) {
    steps.occluded("trace shadow", _buffers.shadowQueue(turn));
    if (_sceneFlags & gpu::SCENE_HAS_MESH_LIGHTS)
        dispatchQueue(steps, "emission", kernel(ShadingKernelId::Emission), gpu::QUEUE_SHADOW + turn, turn);
    passVolumes(steps, "volume shadow", VolumeKernelId::Shadow, gpu::QUEUE_SHADOW, turn);
    dispatchQueue(steps, "shadow", kernel(KernelId::Shadow), gpu::QUEUE_SHADOW + turn, turn);
    const bool shadows = _sceneFlags & gpu::SCENE_HAS_SHADOWS_TO_WALK;
    if (!shadows && !(_sceneFlags & gpu::SCENE_HAS_NON_OPAQUE)) return;
    const uint32_t mask = shadows ? gpu::RAY_MASK_ALL : gpu::RAY_MASK_NON_OPAQUE;
    for (uint32_t i = 0; i < gpu::SHADOW_PASS_LIMIT; ++i) {
        const uint32_t queue = gpu::QUEUE_TRANSMIT + i % 2, other = gpu::QUEUE_TRANSMIT + (i + 1) % 2;
        prepare(steps, bit(queue), bit(other));
        if (steps.onHost() || i % StepsPerLook == StepsPerLook - 1) {
            steps.flush();
            if (queueCount(queue) == 0) break;
        }
        steps.nearest("trace transmit", _buffers.transmitQueue(i % 2, mask));
        dispatchQueue(steps, "transmit", kernel(ShadingKernelId::Transmit), queue, i % 2);
    }
    prepare(steps, 0, bit(gpu::QUEUE_TRANSMIT) | bit(gpu::QUEUE_TRANSMIT + 1));
}

/// Takes the paths of the work from the camera to their ends.
bool PathTracer::tracePaths(Steps& steps, const std::vector<gpu::TileWork>& work, uint32_t paths,
                            const std::atomic<bool>& cancel, const Discovering& discovery) {
    _device.upload(_buffers.tiles, work.data(), work.size() * sizeof(gpu::TileWork));
    raygen(steps, work, paths);
    for (uint32_t round = 0;; ++round) {
        const uint32_t turn = round % 2, other = 1 - turn;
        if (cancel) return false;
        steps.nearest("trace rays", _buffers.rayQueue(turn));
        if (round > 0) resolveShadows(steps, other);
        passVolumes(steps, "volume", VolumeKernelId::Flight, gpu::QUEUE_RAYS, turn);
        discover(steps, "discover", discovery, DiscoveryKernelId::Discover, gpu::QUEUE_RAYS, turn);
        dispatchQueue(steps, "shade", kernel(ShadingKernelId::Shade), gpu::QUEUE_RAYS + turn, turn);
        prepare(steps, bit(gpu::QUEUE_RAYS + other) | bit(gpu::QUEUE_SHADOW + turn),
                bit(gpu::QUEUE_RAYS + turn) | bit(gpu::QUEUE_SHADOW + other));
        discover(steps, "discover shadows", discovery, DiscoveryKernelId::Shadows, gpu::QUEUE_SHADOW, turn);
        if (!steps.onHost() && round % RoundsPerLook != RoundsPerLook - 1) continue;
        steps.flush();
        if (queueCount(gpu::QUEUE_RAYS + other) == 0 && queueCount(gpu::QUEUE_SHADOW + turn) == 0) break;
    }
    return true;
}

bool PathTracer::trace(Traversal& traversal, const std::vector<gpu::TileWork>& tiles, uint32_t paths,
                       const std::atomic<bool>& cancel, DiscoveryPasses* discovery,
                       std::vector<gpu::TileChange>* changes) {
    if (changes) {
        changes->assign(tiles.size(), {});
        _device.upload(_buffers.tileChanges, changes->data(), changes->size() * sizeof(gpu::TileChange));
    }
    Steps steps(_device, traversal, _scene, _profile);
    if (!tracePaths(steps, tiles, paths, cancel, {discovery, false})) return false;
    uint32_t pixels = 0; // of the largest tile
    for (const gpu::TileWork& tile : tiles)
        pixels = std::max(pixels, tile.width * tile.height);
    const auto resolve = [&](const char* name, const Kernel& kernel) {
        steps.run(name, [&kernel, pixels, p = push(), count = uint32_t(tiles.size())](VkCommandBuffer cmd) {
            kernel.dispatch(cmd, &p, groupsOf(pixels), count);
        });
    };
    resolve("resolve", kernel(KernelId::Resolve));
    if (_countsNames) resolve("cryptomatte", _filmKernels->get(size_t(FilmKernelId::Cryptomatte)));
    if (_sortsLight) resolve("light paths", _filmKernels->get(size_t(FilmKernelId::LightPaths)));
    steps.flush();
    if (changes)
        _device.download(_buffers.tileChanges, changes->data(), changes->size() * sizeof(gpu::TileChange));
    return true;
}

bool PathTracer::scout(Traversal& traversal, const std::vector<gpu::TileWork>& work, uint32_t paths,
                       const std::atomic<bool>& cancel, std::vector<gpu::ScoutResult>& results,
                       DiscoveryPasses* discovery) {
    Steps steps(_device, traversal, _scene, _profile);
    if (!tracePaths(steps, work, paths, cancel, {discovery, true})) return false;
    gpu::TraceKernelPush p = push();
    p.count = paths;
    steps.run("scout", [this, p](VkCommandBuffer cmd) {
        kernel(KernelId::Scout).dispatch(cmd, &p, groupsOf(p.count));
    });
    steps.flush();
    results.resize(paths);
    _device.download(_buffers.scoutResults, results.data(), paths * sizeof(gpu::ScoutResult));
    return true;
}

bool PathTracer::findFirstHits(Traversal& traversal, uint32_t first, uint32_t count,
                               const std::atomic<bool>& cancel) {
    Steps steps(_device, traversal, _scene, _profile);
    gpu::TraceKernelPush p = push();
    p.first = first;
    p.count = count;
    steps.run("visibility rays", [this, p, count](VkCommandBuffer cmd) {
        kernel(KernelId::VisibilityRays).dispatch(cmd, &p, groupsOf(count));
    });
    prepare(steps, bit(gpu::QUEUE_RAYS), AllQueues & ~bit(gpu::QUEUE_RAYS));
    for (uint32_t round = 0; round <= gpu::PATH_PASS_LIMIT; ++round) {
        const uint32_t turn = round % 2, other = 1 - turn;
        if (cancel) return false;
        steps.nearest("trace first hits", _buffers.rayQueue(turn));
        dispatchQueue(steps, "visibility", kernel(ShadingKernelId::Visibility), gpu::QUEUE_RAYS + turn, turn);
        prepare(steps, bit(gpu::QUEUE_RAYS + other), bit(gpu::QUEUE_RAYS + turn));
        steps.flush();
        if (queueCount(gpu::QUEUE_RAYS + other) == 0) break;
    }
    return true;
}

void PathTracer::findActive(DiscoveryPasses& discovery, uint32_t pixels) {
    const auto record = [&](VkCommandBuffer cmd) {
        gpu::TraceKernelPush p = push();
        for (p.first = 0; p.first < pixels; p.first += p.count) { // the tiles add up, whatever the order
            p.count = std::min(pixels - p.first, PixelsPerDispatch);
            discovery.kernel(DiscoveryKernelId::Active).dispatch(cmd, &p, groupsOf(p.count));
        }
    };
    _profile.measure("active", [&] { _device.run(record); });
}

gpu::TraceCounters PathTracer::takeCounters() {
    gpu::TraceCounters counters;
    const gpu::TraceCounters zero{};
    _device.download(_buffers.counters, &counters, sizeof(counters));
    _device.upload(_buffers.counters, &zero, sizeof(zero));
    return counters;
}

} // namespace hipr
