/// @file device_instances.h
/// The instance table in device memory.
#pragma once

#include "renderer/accel/instance_table.h"
#include "renderer/vulkan/device.h"

namespace hipr {

class DeviceInstances {
public:
    /// `nodes`: the tree over the instances; empty when the traversal has its own.
    /// `keys`: address of the table's keys.
    void send(Device& device, const InstanceTable& table, const std::vector<gpu::BvhNode>& nodes,
              VkDeviceAddress keys);
    /// Of the gpu::BvhScene; 0 before the first send().
    VkDeviceAddress address() const { return _scene.address(); }

private:
    Buffer _nodes, _instances, _scene;
};

} // namespace hipr
