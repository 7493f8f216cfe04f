#include "renderer/accel/device_instances.h"

namespace hipr {

void DeviceInstances::send(Device& device, const InstanceTable& table, const std::vector<gpu::BvhNode>& nodes,
                           VkDeviceAddress keys) {
    auto put = [&](Buffer& buffer, const void* data, uint64_t bytes) {
        if (buffer.bytes() < bytes || buffer.bytes() > 4 * bytes + 4096) {
            buffer = {};
            buffer = device.createBuffer(bytes, MemoryUse::Device, "acceleration");
        }
        if (bytes) device.upload(buffer, data, bytes);
    };
    put(_nodes, nodes.data(), nodes.size() * sizeof(gpu::BvhNode));
    put(_instances, table.records.data(), table.records.size() * sizeof(gpu::BvhInstance));
    const gpu::BvhScene scene{nodes.empty() ? 0 : _nodes.address(), _instances.address(),  keys, table.extent,
                              uint32_t(table.records.size()),       table.culls ? 1u : 0u, 0};
    put(_scene, &scene, sizeof(scene));
}

} // namespace hipr
