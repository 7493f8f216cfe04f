/// @file device_traversal.h
/// What traversals that run as kernels have in common.
#pragma once

#include "renderer/accel/traversal.h"
#include "renderer/vulkan/kernel.h"

namespace hipr {

class DeviceTraversal : public Traversal {
public:
    DeviceTraversal(Kernel nearest, Kernel occluded)
        : _nearest(std::move(nearest)), _occluded(std::move(occluded)) {}

    void warm() const override {
        _nearest.warm();
        _occluded.warm();
    }
    bool onHost() const override { return false; }
    void nearest(const TraceQueue& queue) override;
    void occluded(const TraceQueue& queue) override;
    void recordNearest(VkCommandBuffer cmd, VkDeviceAddress scene, const TraceQueue& queue) override;
    void recordOccluded(VkCommandBuffer cmd, VkDeviceAddress scene, const TraceQueue& queue) override;
    uint64_t hostBytes() const override { return 0; }

protected:
    Kernel _nearest, _occluded;
};

} // namespace hipr
