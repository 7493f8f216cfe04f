/// @file discovery_passes.h
/// The kernels of paper mode's discovery and what they work on.
///
///     active             which tiles see something that changed, now or before the edit
///     discover           between `nearest` and `shade`: where in the picture a path has come to
///     discover shadows   behind `shade`: shadow rays that come past a place where something changed
///
/// The last two add to the weights of tiles while PathTracer renders a batch.
#pragma once

#include <memory>

#include "renderer/hipr/discovery.h"
#include "renderer/vulkan/background_kernels.h"
#include "renderer/vulkan/device.h"

namespace hipr {

enum class DiscoveryKernelId { Discover, Shadows, Active };

class DiscoveryPasses {
public:
    /// `capacity`: paths a batch can hold.
    DiscoveryPasses(Device& device, uint32_t capacity);

    /// Whether all kernels are compiled; waits up to `patience` for it.
    bool ready(std::chrono::milliseconds patience) { return _kernels.ready(patience); }
    const Kernel& kernel(DiscoveryKernelId id) { return _kernels.get(size_t(id)); }
    /// The DiscoveryRecord, for gpu::TraceRecord; stays the same.
    VkDeviceAddress address() const { return _record.address(); }

    /// Begins a discovery. `previousHits`: address of the first hits before the edit, or 0. `scoutScale`:
    /// pixels that a scout stands for.
    void begin(const TileGrid& grid, const ChangedElements& changed, VkDeviceAddress previousHits,
               const Settings& settings, float scoutScale);

    /// By tile, 1 where something that changed was seen: after `active`.
    std::vector<uint32_t> activeTiles() const;
    /// The tiles whose paths count from now on.
    void setActiveTiles(const std::vector<uint32_t>& active);

    /// Forgets what a batch that was abandoned has added.
    void discardWeights();
    /// Adds what a batch has added, and empties it for the next one.
    void takeWeights(std::vector<uint64_t>& weights);

private:
    Device& _device;
    BackgroundKernels _kernels;
    Buffer _record, _vertices, _elements, _boxes, _active, _weights;
    uint32_t _tiles = 0;
};

} // namespace hipr
