/// @file kernel.h
/// A compute pipeline whose only interface is its push constants (addresses and sizes): no descriptors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <vulkan/vulkan.h>

#include "renderer/vulkan/buffer.h"

namespace hipr {

class Device;

class Kernel {
public:
    Kernel() = default;
    /// `spirvBytes` bytes of SPIR-V with entry point `main`. `tlas`: the kernel also has one acceleration
    /// structure at set 0, binding 0 (ray query). `features`: specialisation constant 0. Throws
    /// std::runtime_error, naming the kernel, when the driver refuses it. Thread-safe: kernels of one device
    /// may be made on several threads at once.
    Kernel(Device& device, const uint32_t* spirv, size_t spirvBytes, uint32_t pushBytes, const char* name,
           bool tlas = false, uint32_t features = ~0u);
    Kernel(Kernel&& o) noexcept;
    Kernel& operator=(Kernel&& o) noexcept;
    ~Kernel();

    /// Records a dispatch of `groups` workgroups.
    void dispatch(VkCommandBuffer cmd, const void* push, uint32_t groupsX, uint32_t groupsY = 1) const;
    /// Records an indirect dispatch; three uints at `offset`.
    void dispatchIndirect(VkCommandBuffer cmd, const void* push, const Buffer& args, uint64_t offset) const;
    /// Rebinds set 0, binding 0. Only for kernels made with `tlas`.
    void setTlas(VkAccelerationStructureKHR tlas);

    /// Makes the driver finish compiling now (blocking). CPU devices otherwise compile in the first dispatch;
    /// an empty dispatch is enough to start it.
    void warm() const;

private:
    void createDescriptors();
    void createPipeline(const uint32_t* spirv, size_t spirvBytes, const char* name, uint32_t features);
    void destroy();
    void bind(VkCommandBuffer cmd, const void* push) const;

    struct Handles {
        Device* device = nullptr;
        VkPipelineLayout layout = VK_NULL_HANDLE;
        VkPipeline pipeline = VK_NULL_HANDLE;
        VkDescriptorSetLayout setLayout = VK_NULL_HANDLE;
        VkDescriptorPool pool = VK_NULL_HANDLE;
        VkDescriptorSet set = VK_NULL_HANDLE;
        uint32_t pushBytes = 0;
    };
    Handles _own;
};

} // namespace hipr
