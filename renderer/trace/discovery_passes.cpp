#include "renderer/trace/discovery_passes.h"

#include <algorithm>

#include "hipr_trace_kernels.h"

namespace hipr {
namespace {

std::vector<KernelSource> sources() {
    constexpr uint32_t push = sizeof(gpu::TraceKernelPush);
    using namespace spirv;
    return {
        {discover_spv, discover_spv_size, push, "discover"},
        {discover_shadows_spv, discover_shadows_spv_size, push, "discover_shadows"},
        {active_spv, active_spv_size, push, "active"},
    };
}

float largestCoordinate(const std::vector<WorldBox>& boxes) {
    float largest = 0.f;
    for (const WorldBox& box : boxes)
        largest = std::max({largest, gpu::largest(box.min), gpu::largest(box.max)});
    return largest;
}

} // namespace

DiscoveryPasses::DiscoveryPasses(Device& device, uint32_t capacity)
    : _device(device), _kernels(device, sources()),
      _record(device.createBuffer(sizeof(gpu::DiscoveryRecord), MemoryUse::Device, "Discovery")),
      _vertices(device.createBuffer(uint64_t(capacity) * sizeof(gpu::DiscoveryVertex), MemoryUse::Device,
                                    "Discovery")),
      _boxes(device.createBuffer(gpu::MAX_CHANGED_BOXES * sizeof(gpu::ChangedBox), MemoryUse::Device,
                                 "Discovery")) {}

void DiscoveryPasses::begin(const TileGrid& grid, const ChangedElements& changed,
                            VkDeviceAddress previousHits, const Settings& settings, float scoutScale) {
    if (_tiles != grid.count()) {
        _tiles = grid.count();
        _active = _device.createBuffer(_tiles * sizeof(uint32_t), MemoryUse::Device, "Discovery");
        _weights = _device.createBuffer(_tiles * sizeof(uint32_t), MemoryUse::Device, "Discovery");
    }
    setActiveTiles(std::vector<uint32_t>(_tiles));
    discardWeights();
    const std::vector<gpu::ElementKey>& keys = changed.keys();
    _elements = _device.createFrom(keys.data(), keys.size(), "Discovery");
    std::vector<gpu::ChangedBox> boxes;
    for (const WorldBox& box : changed.boxes())
        boxes.push_back({box.min, box.max});
    if (!boxes.empty()) _device.upload(_boxes, boxes.data(), boxes.size() * sizeof(gpu::ChangedBox));

    const DiscoveryWeights weights = discoveryWeights(settings);
    gpu::DiscoveryRecord record{};
    record.previousHits = previousHits;
    record.elements = _elements.address();
    record.boxes = _boxes.address();
    record.tileActive = _active.address();
    record.tileWeights = _weights.address();
    record.vertices = _vertices.address();
    record.elementCount = uint32_t(keys.size());
    record.boxCount = uint32_t(boxes.size());
    record.tileSize = grid.tileSize;
    record.tileColumns = grid.columns;
    record.eps = settings.eps;
    record.boxExtent = largestCoordinate(changed.boxes());
    record.scoutScale = scoutScale;
    record.shadowWeight = weights.shadow();
    record.scatterWeights = weights.scatter;
    record.pathWeights = weights.path;
    _device.upload(_record, &record, sizeof(record));
}

std::vector<uint32_t> DiscoveryPasses::activeTiles() const {
    std::vector<uint32_t> active(_tiles);
    _device.download(_active, active.data(), active.size() * sizeof(uint32_t));
    return active;
}

void DiscoveryPasses::setActiveTiles(const std::vector<uint32_t>& active) {
    _device.upload(_active, active.data(), active.size() * sizeof(uint32_t));
}

void DiscoveryPasses::discardWeights() {
    const std::vector<uint32_t> zeros(_tiles);
    _device.upload(_weights, zeros.data(), zeros.size() * sizeof(uint32_t));
}

void DiscoveryPasses::takeWeights(std::vector<uint64_t>& weights) {
    std::vector<uint32_t> added(_tiles);
    _device.download(_weights, added.data(), added.size() * sizeof(uint32_t));
    weights.resize(_tiles);
    for (uint32_t tile = 0; tile < _tiles; ++tile)
        weights[tile] += added[tile];
    discardWeights();
}

} // namespace hipr
