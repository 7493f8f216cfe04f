#include "renderer/accel/ray_query_structures.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/vulkan/result.h"

namespace hipr {
namespace {

constexpr uint32_t UPDATES_BEFORE_REBUILD = 32;
constexpr uint64_t SCRATCH_BUDGET = 64u << 20; ///< builds that fit together run together
constexpr uint64_t SCRATCH_ALIGNMENT = 256;    ///< the most the specification lets a device ask for

template <class Function> Function load(VkDevice device, const char* name) {
    const auto f = reinterpret_cast<Function>(vkGetDeviceProcAddr(device, name));
    if (!f) throw std::runtime_error(std::string("the device has no ") + name);
    return f;
}

uint64_t aligned(uint64_t bytes) {
    return (bytes + SCRATCH_ALIGNMENT - 1) / SCRATCH_ALIGNMENT * SCRATCH_ALIGNMENT;
}

} // namespace

RayQueryFunctions::RayQueryFunctions(const Device& device) {
    if (!device.info().rayQuery) throw std::runtime_error(device.info().name + " has no VK_KHR_ray_query");
    const VkDevice d = device.handle();
    buildSizes =
        load<PFN_vkGetAccelerationStructureBuildSizesKHR>(d, "vkGetAccelerationStructureBuildSizesKHR");
    create = load<PFN_vkCreateAccelerationStructureKHR>(d, "vkCreateAccelerationStructureKHR");
    destroy = load<PFN_vkDestroyAccelerationStructureKHR>(d, "vkDestroyAccelerationStructureKHR");
    build = load<PFN_vkCmdBuildAccelerationStructuresKHR>(d, "vkCmdBuildAccelerationStructuresKHR");
    address =
        load<PFN_vkGetAccelerationStructureDeviceAddressKHR>(d, "vkGetAccelerationStructureDeviceAddressKHR");
}

RayQueryStructure::~RayQueryStructure() {
    if (_structure) _functions.destroy(_device.handle(), _structure, nullptr);
}

void RayQueryStructure::planTriangles(const GeometryView& view) {
    _geometry = {};
    _geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    _geometry.geometryType = VK_GEOMETRY_TYPE_TRIANGLES_KHR;
    auto& t = _geometry.geometry.triangles;
    t.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_TRIANGLES_DATA_KHR;
    t.vertexFormat = VK_FORMAT_R32G32B32_SFLOAT;
    t.vertexData.deviceAddress = view.positionsAddress;
    t.vertexStride = sizeof(glm::vec3);
    t.maxVertex = view.vertexCount - 1;
    t.indexType = VK_INDEX_TYPE_UINT32;
    t.indexData.deviceAddress = view.trianglesAddress;
    planGeometry(view);
}

void RayQueryStructure::planSegments(const GeometryView& view, VkDeviceAddress boxes) {
    _geometry = {};
    _geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    _geometry.geometryType = VK_GEOMETRY_TYPE_AABBS_KHR;
    auto& b = _geometry.geometry.aabbs;
    b.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_AABBS_DATA_KHR;
    b.data.deviceAddress = boxes;
    b.stride = sizeof(VkAabbPositionsKHR);
    planGeometry(view);
}

void RayQueryStructure::planGeometry(const GeometryView& view) {
    const bool again = _structure && view.sameTopology && view.triangleCount == _builtPrimitives;
    const bool update = again && _updatable && _updates < UPDATES_BEFORE_REBUILD;
    _moves = again;
    _updates = update ? _updates + 1 : 0;
    plan(VK_ACCELERATION_STRUCTURE_TYPE_BOTTOM_LEVEL_KHR, view.triangleCount, update, _moves);
}

void RayQueryStructure::planInstances(VkDeviceAddress instances, uint32_t count) {
    _geometry = {};
    _geometry.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_KHR;
    _geometry.geometryType = VK_GEOMETRY_TYPE_INSTANCES_KHR;
    auto& i = _geometry.geometry.instances;
    i.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_GEOMETRY_INSTANCES_DATA_KHR;
    i.data.deviceAddress = instances;
    plan(VK_ACCELERATION_STRUCTURE_TYPE_TOP_LEVEL_KHR, count, false, false);
}

void RayQueryStructure::plan(VkAccelerationStructureTypeKHR type, uint32_t primitives, bool update,
                             bool updatable) {
    _primitives = primitives;
    _info = {};
    _info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_GEOMETRY_INFO_KHR;
    _info.type = type;
    _info.flags = VK_BUILD_ACCELERATION_STRUCTURE_PREFER_FAST_TRACE_BIT_KHR;
    if (updatable) _info.flags |= VK_BUILD_ACCELERATION_STRUCTURE_ALLOW_UPDATE_BIT_KHR;
    _info.mode = update ? VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR
                        : VK_BUILD_ACCELERATION_STRUCTURE_MODE_BUILD_KHR;
    _info.geometryCount = 1;
    _info.pGeometries = &_geometry;
    VkAccelerationStructureBuildSizesInfoKHR sizes{};
    sizes.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_BUILD_SIZES_INFO_KHR;
    _functions.buildSizes(_device.handle(), VK_ACCELERATION_STRUCTURE_BUILD_TYPE_DEVICE_KHR, &_info,
                          &primitives, &sizes);
    _scratchBytes = aligned(update ? sizes.updateScratchSize : sizes.buildScratchSize);
    _updatable = updatable;
    _builtPrimitives = primitives;
    if (update) return;
    if (_structure) _functions.destroy(_device.handle(), _structure, nullptr);
    _structure = VK_NULL_HANDLE;
    if (_buffer.bytes() < sizes.accelerationStructureSize ||
        _buffer.bytes() / 2 > sizes.accelerationStructureSize) {
        _buffer = {};
        _buffer = _device.createBuffer(sizes.accelerationStructureSize, MemoryUse::Device, "acceleration");
    }
    VkAccelerationStructureCreateInfoKHR create{};
    create.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_CREATE_INFO_KHR;
    create.buffer = _buffer.handle();
    create.size = sizes.accelerationStructureSize;
    create.type = type;
    check(_functions.create(_device.handle(), &create, nullptr, &_structure),
          "vkCreateAccelerationStructureKHR");
    VkAccelerationStructureDeviceAddressInfoKHR info{};
    info.sType = VK_STRUCTURE_TYPE_ACCELERATION_STRUCTURE_DEVICE_ADDRESS_INFO_KHR;
    info.accelerationStructure = _structure;
    _address = _functions.address(_device.handle(), &info);
}

void RayQueryStructure::record(VkCommandBuffer cmd, VkDeviceAddress scratch) {
    _info.dstAccelerationStructure = _structure;
    if (_info.mode == VK_BUILD_ACCELERATION_STRUCTURE_MODE_UPDATE_KHR)
        _info.srcAccelerationStructure = _structure;
    _info.scratchData.deviceAddress = scratch;
    const VkAccelerationStructureBuildRangeInfoKHR range{_primitives, 0, 0, 0};
    const VkAccelerationStructureBuildRangeInfoKHR* ranges = &range;
    _functions.build(cmd, 1, &_info, &ranges);
}

void buildStructures(Device& device, const std::vector<RayQueryStructure*>& structures) {
    for (size_t first = 0; first < structures.size();) {
        size_t last = first;
        uint64_t bytes = 0;
        do
            bytes += structures[last++]->scratchBytes();
        while (last < structures.size() && bytes + structures[last]->scratchBytes() <= SCRATCH_BUDGET);
        const Buffer scratch = device.createBuffer(bytes, MemoryUse::Device, "acceleration scratch");
        device.run([&](VkCommandBuffer cmd) {
            VkDeviceAddress at = scratch.address();
            for (size_t i = first; i < last; ++i) {
                structures[i]->record(cmd, at);
                at += structures[i]->scratchBytes();
            }
        });
        first = last;
    }
}

} // namespace hipr
