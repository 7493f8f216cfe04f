#include "renderer/accel/device_traversal.h"

#include <cstddef>
#include <stdexcept>

namespace hipr {
namespace {

void record(const Kernel& kernel, VkCommandBuffer cmd, VkDeviceAddress scene, const TraceQueue& queue) {
    const gpu::TracePush push{scene,
                              queue.header->address() + queue.headerOffset,
                              queue.rays->address(),
                              queue.results->address(),
                              queue.mask,
                              0};
    kernel.dispatchIndirect(cmd, &push, *queue.header,
                            queue.headerOffset + offsetof(gpu::QueueHeader, groupsX));
}

[[noreturn]] void callingIsWrong() {
    throw std::logic_error("this traversal runs on the device; record it into a command buffer");
}

} // namespace

void DeviceTraversal::nearest(const TraceQueue&) {
    callingIsWrong();
}
void DeviceTraversal::occluded(const TraceQueue&) {
    callingIsWrong();
}

void DeviceTraversal::recordNearest(VkCommandBuffer cmd, VkDeviceAddress scene, const TraceQueue& queue) {
    record(_nearest, cmd, scene, queue);
}

void DeviceTraversal::recordOccluded(VkCommandBuffer cmd, VkDeviceAddress scene, const TraceQueue& queue) {
    record(_occluded, cmd, scene, queue);
}

} // namespace hipr
