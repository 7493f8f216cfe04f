#include "testenv/common/vulkan_faults.h"

#include <atomic>
#include <cstring>
#include <stdexcept>
#include <string>

#include <dlfcn.h>

namespace hipr::test {
namespace {

std::atomic<bool> armed{false};
std::atomic<Fault> wanted{Fault::OutOfMemory};
std::atomic<uint64_t> failAt{0}, callCount{0};
std::atomic<const char*> failedCall{nullptr};

enum class Kind { Making, Submitting };

/// Whether this call is to fail, and how.
VkResult injected(Kind kind, const char* name) {
    const bool losing = wanted == Fault::DeviceLost;
    if (!armed || losing != (kind == Kind::Submitting)) return VK_SUCCESS;
    const uint64_t call = ++callCount, at = failAt;
    if (at == 0 || call < at || (call > at && wanted == Fault::OutOfMemory)) return VK_SUCCESS;
    if (call == at) failedCall = name;
    return losing     ? VK_ERROR_DEVICE_LOST
           : call % 2 ? VK_ERROR_OUT_OF_DEVICE_MEMORY
                      : VK_ERROR_OUT_OF_HOST_MEMORY;
}

/// The function of this name behind ours.
template <class F> F loaderFunction(const char* name) {
    static void* const loader = dlopen("libvulkan.so.1", RTLD_NOW);
    void* const function = loader ? dlsym(loader, name) : nullptr;
    if (!function) throw std::runtime_error(std::string("the Vulkan loader has no ") + name);
    return reinterpret_cast<F>(function);
}

/// Not in the loader but in the device.
PFN_vkCreateAccelerationStructureKHR createAccelerationStructure;

VKAPI_ATTR VkResult VKAPI_CALL faultyCreateAccelerationStructure(
    VkDevice device, const VkAccelerationStructureCreateInfoKHR* info, const VkAllocationCallbacks* allocator,
    VkAccelerationStructureKHR* structure) {
    const VkResult result = injected(Kind::Making, "vkCreateAccelerationStructureKHR");
    return result ? result : createAccelerationStructure(device, info, allocator, structure);
}

} // namespace

VulkanFault::VulkanFault(Fault fault, uint64_t n) {
    if (armed) throw std::logic_error("one fault at a time");
    wanted = fault;
    failAt = n;
    callCount = 0;
    failedCall = nullptr;
    armed = true;
}

VulkanFault::~VulkanFault() {
    armed = false;
}

uint64_t VulkanFault::calls() const {
    return callCount;
}

const char* VulkanFault::failed() const {
    return failedCall;
}

} // namespace hipr::test

using hipr::test::injected;
using hipr::test::Kind;
using hipr::test::loaderFunction;

/// Defines a function of the loader's that may fail.
#define FAULTY(kind, name, parameters, arguments)                                                            \
    extern "C" VKAPI_ATTR VkResult VKAPI_CALL name parameters {                                              \
        static const auto next = loaderFunction<PFN_##name>(#name);                                          \
        const VkResult result = injected(Kind::kind, #name);                                                 \
        return result ? result : next arguments;                                                             \
    }

using Allocator = const VkAllocationCallbacks*;

FAULTY(Making, vkCreateInstance, (const VkInstanceCreateInfo* i, Allocator a, VkInstance* out), (i, a, out))
FAULTY(Making, vkEnumeratePhysicalDevices, (VkInstance v, uint32_t* n, VkPhysicalDevice* out), (v, n, out))
FAULTY(Making, vkEnumerateDeviceExtensionProperties,
       (VkPhysicalDevice p, const char* layer, uint32_t* n, VkExtensionProperties* out), (p, layer, n, out))
FAULTY(Making, vkCreateDevice, (VkPhysicalDevice p, const VkDeviceCreateInfo* i, Allocator a, VkDevice* out),
       (p, i, a, out))
FAULTY(Making, vkCreateCommandPool,
       (VkDevice d, const VkCommandPoolCreateInfo* i, Allocator a, VkCommandPool* out), (d, i, a, out))
FAULTY(Making, vkAllocateCommandBuffers,
       (VkDevice d, const VkCommandBufferAllocateInfo* i, VkCommandBuffer* out), (d, i, out))
FAULTY(Making, vkCreateFence, (VkDevice d, const VkFenceCreateInfo* i, Allocator a, VkFence* out),
       (d, i, a, out))
FAULTY(Making, vkCreatePipelineCache,
       (VkDevice d, const VkPipelineCacheCreateInfo* i, Allocator a, VkPipelineCache* out), (d, i, a, out))
FAULTY(Making, vkGetPipelineCacheData, (VkDevice d, VkPipelineCache c, size_t* n, void* out), (d, c, n, out))
FAULTY(Making, vkAllocateMemory,
       (VkDevice d, const VkMemoryAllocateInfo* i, Allocator a, VkDeviceMemory* out), (d, i, a, out))
FAULTY(Making, vkMapMemory,
       (VkDevice d, VkDeviceMemory m, VkDeviceSize at, VkDeviceSize n, VkMemoryMapFlags f, void** out),
       (d, m, at, n, f, out))
FAULTY(Making, vkCreateBuffer, (VkDevice d, const VkBufferCreateInfo* i, Allocator a, VkBuffer* out),
       (d, i, a, out))
FAULTY(Making, vkBindBufferMemory, (VkDevice d, VkBuffer b, VkDeviceMemory m, VkDeviceSize at), (d, b, m, at))
FAULTY(Making, vkCreateShaderModule,
       (VkDevice d, const VkShaderModuleCreateInfo* i, Allocator a, VkShaderModule* out), (d, i, a, out))
FAULTY(Making, vkCreatePipelineLayout,
       (VkDevice d, const VkPipelineLayoutCreateInfo* i, Allocator a, VkPipelineLayout* out), (d, i, a, out))
FAULTY(Making, vkCreateComputePipelines,
       (VkDevice d, VkPipelineCache c, uint32_t n, const VkComputePipelineCreateInfo* i, Allocator a,
        VkPipeline* out),
       (d, c, n, i, a, out))
FAULTY(Making, vkCreateDescriptorSetLayout,
       (VkDevice d, const VkDescriptorSetLayoutCreateInfo* i, Allocator a, VkDescriptorSetLayout* out),
       (d, i, a, out))
FAULTY(Making, vkCreateDescriptorPool,
       (VkDevice d, const VkDescriptorPoolCreateInfo* i, Allocator a, VkDescriptorPool* out), (d, i, a, out))
FAULTY(Making, vkAllocateDescriptorSets,
       (VkDevice d, const VkDescriptorSetAllocateInfo* i, VkDescriptorSet* out), (d, i, out))
FAULTY(Making, vkBeginCommandBuffer, (VkCommandBuffer c, const VkCommandBufferBeginInfo* i), (c, i))
FAULTY(Making, vkEndCommandBuffer, (VkCommandBuffer c), (c))
FAULTY(Submitting, vkQueueSubmit, (VkQueue q, uint32_t n, const VkSubmitInfo* i, VkFence f), (q, n, i, f))
FAULTY(Submitting, vkWaitForFences, (VkDevice d, uint32_t n, const VkFence* f, VkBool32 all, uint64_t ns),
       (d, n, f, all, ns))

extern "C" VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL vkGetDeviceProcAddr(VkDevice device, const char* name) {
    static const auto next = loaderFunction<PFN_vkGetDeviceProcAddr>("vkGetDeviceProcAddr");
    const PFN_vkVoidFunction function = next(device, name);
    if (!function || std::strcmp(name, "vkCreateAccelerationStructureKHR") != 0) return function;
    hipr::test::createAccelerationStructure =
        reinterpret_cast<PFN_vkCreateAccelerationStructureKHR>(function);
    return reinterpret_cast<PFN_vkVoidFunction>(&hipr::test::faultyCreateAccelerationStructure);
}
