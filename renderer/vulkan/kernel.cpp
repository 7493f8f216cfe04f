#include "renderer/vulkan/kernel.h"

#include <stdexcept>
#include <utility>
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
               bool tlas, uint32_t features) {
    _own.device = &device;
    _own.pushBytes = pushBytes;
    try {
        if (tlas) createDescriptors();
        createPipeline(spirv, spirvBytes, name, features);
    } catch (...) {
        destroy(); // a constructor that throws runs no destructor
        throw;
    }
}

void Kernel::createDescriptors() {
    if (!_own.device->info().rayQuery) throw std::runtime_error("the device has no ray query");
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
    check(vkCreateDescriptorSetLayout(_own.device->handle(), &layout, nullptr, &_own.setLayout),
          "vkCreateDescriptorSetLayout");

    const VkDescriptorPoolSize size{VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR, 1};
    auto pool = vkStruct<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    pool.maxSets = pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    check(vkCreateDescriptorPool(_own.device->handle(), &pool, nullptr, &_own.pool),
          "vkCreateDescriptorPool");

    auto allocate = vkStruct<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = _own.pool;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = &_own.setLayout;
    check(vkAllocateDescriptorSets(_own.device->handle(), &allocate, &_own.set), "vkAllocateDescriptorSets");
}

void Kernel::createPipeline(const uint32_t* spirv, size_t spirvBytes, const char* name, uint32_t features) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(_own.device->physical(), &properties);
    if (_own.pushBytes > properties.limits.maxPushConstantsSize)
        throw std::runtime_error(std::string("kernel ") + name + " has " + std::to_string(_own.pushBytes) +
                                 " bytes of push constants, the device takes " +
                                 std::to_string(properties.limits.maxPushConstantsSize));
    const VkPushConstantRange push{VK_SHADER_STAGE_COMPUTE_BIT, 0, _own.pushBytes};
    auto layout = vkStruct<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    layout.setLayoutCount = _own.setLayout ? 1 : 0;
    layout.pSetLayouts = &_own.setLayout;
    layout.pushConstantRangeCount = _own.pushBytes ? 1 : 0;
    layout.pPushConstantRanges = &push;
    check(vkCreatePipelineLayout(_own.device->handle(), &layout, nullptr, &_own.layout), name);

    const ShaderModule shader(_own.device->handle(), spirv, spirvBytes);
    auto info = vkStruct<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.module = shader.module;
    info.stage.pName = "main";
    const VkSpecializationMapEntry entry{0, 0, sizeof features};
    const VkSpecializationInfo specialization{1, &entry, sizeof features, &features};
    info.stage.pSpecializationInfo = &specialization;
    info.layout = _own.layout;
    check(vkCreateComputePipelines(_own.device->handle(), _own.device->pipelineCache(), 1, &info, nullptr,
                                   &_own.pipeline),
          name);
}

void Kernel::destroy() {
    if (!_own.device) return;
    vkDestroyPipeline(_own.device->handle(), _own.pipeline, nullptr);
    vkDestroyPipelineLayout(_own.device->handle(), _own.layout, nullptr);
    vkDestroyDescriptorPool(_own.device->handle(), _own.pool, nullptr);
    vkDestroyDescriptorSetLayout(_own.device->handle(), _own.setLayout, nullptr);
}

Kernel::Kernel(Kernel&& o) noexcept : _own(std::exchange(o._own, {})) {}

Kernel& Kernel::operator=(Kernel&& o) noexcept {
    Kernel old(std::move(o));
    std::swap(_own, old._own);
    return *this;
}

Kernel::~Kernel() {
    destroy();
}

void Kernel::bind(VkCommandBuffer cmd, const void* push) const {
    vkCmdBindPipeline(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, _own.pipeline);
    if (_own.set)
        vkCmdBindDescriptorSets(cmd, VK_PIPELINE_BIND_POINT_COMPUTE, _own.layout, 0, 1, &_own.set, 0,
                                nullptr);
    if (_own.pushBytes)
        vkCmdPushConstants(cmd, _own.layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, _own.pushBytes, push);
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
    write.dstSet = _own.set;
    write.descriptorCount = 1;
    write.descriptorType = VK_DESCRIPTOR_TYPE_ACCELERATION_STRUCTURE_KHR;
    vkUpdateDescriptorSets(_own.device->handle(), 1, &write, 0, nullptr);
}

void Kernel::warm() const {
    const std::vector<char> push(_own.pushBytes);
    _own.device->run([&](VkCommandBuffer cmd) { dispatch(cmd, push.data(), 0); });
}

} // namespace hipr
