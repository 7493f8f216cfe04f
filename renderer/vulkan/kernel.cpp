#include "renderer/vulkan/kernel.h"

#include <stdexcept>
#include <vector>

#include "renderer/vulkan/device.h"
#include "renderer/vulkan/result.h"
#include "renderer/vulkan/structs.h"

namespace hipr {

namespace {

struct ShaderModule {
    ShaderModule(VkDevice device, const uint32_t* spirv, size_t bytes) : device(device) {
        auto info = vkStruct<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        info.codeSize = bytes;
        info.pCode = spirv;
        check(vkCreateShaderModule(device, &info, nullptr, &module), "vkCreateShaderModule");
    }
    ~ShaderModule() { vkDestroyShaderModule(device, module, nullptr); }
    ShaderModule(const ShaderModule&) = delete;
    ShaderModule& operator=(const ShaderModule&) = delete;
    VkDevice device;
    VkShaderModule module = VK_NULL_HANDLE;
};

} // namespace

Kernel::Kernel(Device& device, const uint32_t* spirv, size_t spirvBytes, uint32_t pushBytes, const char* name,
               bool tlas)
    : _device(&device), _pushBytes(pushBytes) {
    try {
        if (tlas) createDescriptors();
        createPipeline(spirv, spirvBytes, name);
    } catch (...) {
        destroy(); // a constructor that throws runs no destructor
        throw;
    }
}

void Kernel::createDescriptors() {
    if (!_device->info().rayQuery) throw std::runtime_error("the device has no ray query");
    VkDescriptorSetLayoutBinding binding{};
    binding.descriptorType = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    binding.descriptorCount = 1;
    binding.stageFlags = VK_SHADER_STAGE_COMPUTE_BIT;
    const VkDescriptorBindingFlags partiallyBound = VK_DESCRIPTOR_BINDING_PARTIALLY_BOUND_BIT; // see warm()
    auto flags = vkStruct<VkDescriptorSetLayoutBindingFlagsCreateInfo>(
        VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_BINDING_FLAGS_CREATE_INFO);
    flags.bindingCount = 1;
    flags.pBindingFlags = &partiallyBound;
    auto layout =
        vkStruct<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    layout.pNext = &flags;
    layout.bindingCount = 1;
    layout.pBindings = &binding;
    check(vkCreateDescriptorSetLayout(_device->handle(), &layout, nullptr, &_setLayout),
          "vkCreateDescriptorSetLayout");

    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1};
    auto pool = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool.maxSets = pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vkCreateDescriptorPool(_device->handle(), &pool, nullptr, &_pool), "vkCreateDescriptorPool");

    auto allocate = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = _pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &_setLayout;
    check(vkAllocateDescriptorSets(_device->handle(), &allocate, &_set), "vkAllocateDescriptorSets");
}

void Kernel::createPipeline(const uint32_t* spirv, size_t spirvBytes, const char* name) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(_device->physical(), &properties);
    if (_pushBytes > properties.limits.maxPushConstantsSize)
        throw std::runtime_error(std::string("kernel ") + name + " has " + std::to_string(_pushBytes) +
                                 " bytes of push constants, the device takes " +
                                 std::to_string(properties.limits.maxPushConstantsSize));
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, _pushBytes};
    auto layout = vkStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = _setLayout ? 1 : 0;
    layout.pSetLayouts = &_setLayout;
    layout.pushConstantRangeCount = _pushBytes ? 1 : 0;
    layout.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(_device->handle(), &layout, nullptr, &_layout), name);

    const ShaderModule shader(_device->handle(), spirv, spirvBytes);
    auto info = vkStruct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader.module;
    info.stage.pName = "main";
    info.layout = _layout;
    check(
        vkCreateComputePipelines(_device->handle(), _device->pipelineCache(), 1, &info, nullptr, &_pipeline),
        name);
}

void Kernel::destroy() {
    if (!_device) return;
    vkDestroyPipeline(_device->handle(), _pipeline, nullptr);
    vkDestroyPipelineLayout(_device->handle(), _layout, nullptr);
    vkDestroyDescriptorPool(_device->handle(), _pool, nullptr);
    vkDestroyDescriptorSetLayout(_device->handle(), _setLayout, nullptr);
}

Kernel::Kernel(Kernel&& o) noexcept {
    swap(o);
}

Kernel& Kernel::operator=(Kernel&& o) noexcept {
    Kernel(std::move(o)).swap(*this);
    return *this;
}

Kernel::~Kernel() {
    destroy();
}

void Kernel::swap(Kernel& o) noexcept {
    std::swap(_device, o._device);
    std::swap(_layout, o._layout);
    std::swap(_pipeline, o._pipeline);
    std::swap(_setLayout, o._setLayout);
    std::swap(_pool, o._pool);
    std::swap(_set, o._set);
    std::swap(_pushBytes, o._pushBytes);
}

void Kernel::bind(VkCommandBuffer cmd, const void* push) const {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, _pipeline);
    if (_set) vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, _layout, 0, 1, &_set, 0, nullptr);
    if (_pushBytes) vkCmdPushConstants(cmd, _layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, _pushBytes, push);
}

void Kernel::dispatch(VkCommandBuffer cmd, const void* push, uint32_t groupsX, uint32_t groupsY) const {
    bind(cmd, push);
    vkCmdDispatch(cmd, groupsX, groupsY, 1);
}

void Kernel::dispatchIndirect(VkCommandBuffer cmd, const void* push, const Buffer& args,
                              uint64_t offset) const {
    bind(cmd, push);
    vkCmdDispatchIndirect(cmd, args.handle(), offset);
}

void Kernel::setTlas(VkAccelerationStructureKHR tlas) {
    auto structure = vkStruct<VkWriteDescriptorSetAccelerationStructureKHR>(
        VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET_ACCELERATION_STRUCTURE_KHR);
    structure.accelerationStructureCount = 1;
    structure.pAccelerationStructures = &tlas;
    auto write = vkStruct<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
    write.pNext = &structure;
    write.dstSet = _set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    vkUpdateDescriptorSets(_device->handle(), 1, &write, 0, nullptr);
}

void Kernel::warm() const {
    const std::vector<char> push(_pushBytes);
    _device->run([&](VkCommandBuffer cmd) { dispatch(cmd, push.data(), 0); });
}

} // namespace hipr
