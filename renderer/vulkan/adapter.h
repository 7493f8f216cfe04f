/// @file adapter.h
/// Physical devices: what each can do, and which one to use.
#pragma once

#include <optional>
#include <vector>

#include <vulkan/vulkan.h>

#include "renderer/api/renderer.h"
#include "renderer/vulkan/structs.h"

namespace hipr {

/// The feature structs of Vulkan 1.2 and the extensions the renderer may use, as one chain.
struct Features {
    VkPhysicalDeviceFeatures2 core =
        vkStruct<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    VkPhysicalDeviceVulkan11Features v11 =
        vkStruct<VkPhysicalDeviceVulkan11Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_FEATURES);
    VkPhysicalDeviceVulkan12Features v12 =
        vkStruct<VkPhysicalDeviceVulkan12Features>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES);
    VkPhysicalDeviceAccelerationStructureFeaturesKHR accelerationStructure =
        vkStruct<VkPhysicalDeviceAccelerationStructureFeaturesKHR>(
            VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR);
    VkPhysicalDeviceRayQueryFeaturesKHR rayQuery = vkStruct<VkPhysicalDeviceRayQueryFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR);

    /// Chains the structs; the extension structs only when `withRayQuery`. The chain points into this object.
    void link(bool withRayQuery);
};

/// One physical device and the answer to "can we use it, and for what".
struct Adapter {
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    DeviceInfo info;
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    uint32_t queueFamily = 0;
    uint64_t maxBufferBytes = 0;
    bool memoryBudget = false; ///< VK_EXT_memory_budget
    bool hostMemory = false;   ///< all device memory is host-visible and host-coherent at full speed
};

/// All devices in the driver's order, usable or not.
std::vector<Adapter> listAdapters(VkInstance instance);

/// Chooses by `selector` (an index, or part of a name in any case); when it is empty by $HIPR_DEVICE, and
/// when that is empty too the best usable device: discrete, integrated, virtual, then CPU. Null with the
/// reason in `error`.
const Adapter* chooseAdapter(const std::vector<Adapter>& adapters, const std::string& selector,
                             std::string* error);

/// Every feature the device has out of those the renderer requires or can use.
Features featuresToEnable(const Adapter& adapter);

/// Extensions to enable with them.
std::vector<const char*> extensionsToEnable(const Adapter& adapter);

} // namespace hipr
