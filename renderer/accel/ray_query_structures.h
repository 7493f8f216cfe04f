/// @file ray_query_structures.h
/// Acceleration structures of VK_KHR_acceleration_structure.
#pragma once

#include <vector>

#include "renderer/accel/instance_table.h"
#include "renderer/accel/traversal.h"

namespace hipr {

/// The extension's entry points; throws std::runtime_error when the device has none.
struct RayQueryFunctions {
    explicit RayQueryFunctions(const Device& device);
    PFN_vkGetAccelerationStructureBuildSizesKHR buildSizes;
    PFN_vkCreateAccelerationStructureKHR create;
    PFN_vkDestroyAccelerationStructureKHR destroy;
    PFN_vkCmdBuildAccelerationStructuresKHR build;
    PFN_vkGetAccelerationStructureDeviceAddressKHR address;
};

/// One bottom- or top-level structure and what its next build needs.
class RayQueryStructure {
public:
    RayQueryStructure(Device& device, const RayQueryFunctions& functions)
        : _device(device), _functions(functions) {}
    ~RayQueryStructure();
    RayQueryStructure(const RayQueryStructure&) = delete;
    RayQueryStructure& operator=(const RayQueryStructure&) = delete;

    /// Plans a build over triangles. Sizes are known afterwards. A geometry that moved before is built for
    /// updates, and updated from then on when `sameTopology`; after 32 updates it is built anew, since
    /// updates wear a tree out.
    void planTriangles(const GeometryView& view);
    /// Likewise over the VkAabbPositionsKHR of its segments at `boxes`.
    void planSegments(const GeometryView& view, VkDeviceAddress boxes);
    /// Plans a build over VkAccelerationStructureInstanceKHR[count] at `instances`.
    void planInstances(VkDeviceAddress instances, uint32_t count);

    /// Scratch memory of the planned build.
    uint64_t scratchBytes() const { return _scratchBytes; }
    void record(VkCommandBuffer cmd, VkDeviceAddress scratch);

    VkAccelerationStructureKHR handle() const { return _structure; }
    VkDeviceAddress address() const { return _address; }

private:
    void planGeometry(const GeometryView& view);
    void plan(VkAccelerationStructureTypeKHR type, uint32_t primitives, bool update, bool updatable);

    Device& _device;
    const RayQueryFunctions& _functions;
    Buffer _buffer;
    VkAccelerationStructureKHR _structure = VK_NULL_HANDLE;
    VkDeviceAddress _address = 0;
    VkAccelerationStructureGeometryKHR _geometry{};
    VkAccelerationStructureBuildGeometryInfoKHR _info{};
    uint32_t _primitives = 0, _builtPrimitives = 0;
    uint64_t _scratchBytes = 0;
    uint32_t _updates = 0;
    bool _moves = false, _updatable = false;
};

/// Builds what was planned (blocking), within a bounded amount of scratch memory.
void buildStructures(Device& device, const std::vector<RayQueryStructure*>& structures);

} // namespace hipr
