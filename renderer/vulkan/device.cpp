#include "renderer/vulkan/device.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <mutex>

#include "renderer/vulkan/adapter.h"
#include "renderer/vulkan/instance.h"
#include "renderer/vulkan/memory.h"
#include "renderer/vulkan/pipelinecache.h"
#include "renderer/vulkan/structs.h"

namespace hipr {

namespace {

constexpr uint64_t StagingBytes = 32ull << 20;

void toStandardError(Severity severity, const std::string& subject, const std::string& text) {
    const char* level = severity == Severity::Error     ? "error"
                        : severity == Severity::Warning ? "warning"
                                                        : "info";
    std::cerr << "hipr: " << level << ": " + (subject.empty() ? "" : subject + ": ") + text + "\n";
}

bool environmentSays(const char* variable) {
    const char* value = std::getenv(variable);
    return value && std::strcmp(value, "1") == 0;
}

} // namespace

struct Device::Impl {
    MessageSink messages;
    std::unique_ptr<Instance> instance;
    Adapter adapter;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    std::unique_ptr<MemoryPool> pool;
    std::unique_ptr<PipelineCache> cache;
    std::vector<uint32_t> memoryTypesOf[3]; ///< by MemoryUse

    std::mutex submitMutex; ///< guards the command buffer, the fence and the queue
    VkCommandPool commandPool = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    bool lost = false;

    struct Staging {
        MemoryUse use;
        std::mutex mutex;
        Buffer buffer;
    };
    Staging uploads{MemoryUse::Upload, {}, {}}, readbacks{MemoryUse::Readback, {}, {}};

    void createDevice();
    void createCommands();
    void chooseMemoryTypes();
    void create(const RendererOptions& options, std::string* error);
    void submit();
    ~Impl();
};

void Device::Impl::createDevice() {
    const float priority = 1.f;
    auto queueInfo = vkStruct<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queueInfo.queueFamilyIndex = adapter.queueFamily;
    queueInfo.queueCount = 1;
    queueInfo.pQueuePriorities = &priority;
    Features features = featuresToEnable(adapter);
    features.link(adapter.info.rayQuery);
    const std::vector<const char*> extensions = extensionsToEnable(adapter);
    auto info = vkStruct<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    info.pNext = &features.core;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queueInfo;
    info.enabledExtensionCount = uint32_t(extensions.size());
    info.ppEnabledExtensionNames = extensions.data();
    check(vkCreateDevice(adapter.physical, &info, nullptr, &device), "vkCreateDevice");
    vkGetDeviceQueue(device, adapter.queueFamily, 0, &queue);
}

void Device::Impl::createCommands() {
    auto poolInfo = vkStruct<VkCommandPoolCreateInfo>(VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO);
    poolInfo.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT | VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
    poolInfo.queueFamilyIndex = adapter.queueFamily;
    check(vkCreateCommandPool(device, &poolInfo, nullptr, &commandPool), "vkCreateCommandPool");
    auto allocate = vkStruct<VkCommandBufferAllocateInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO);
    allocate.commandPool = commandPool;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(device, &allocate, &commands), "vkAllocateCommandBuffers");
    auto fenceInfo = vkStruct<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
    check(vkCreateFence(device, &fenceInfo, nullptr, &fence), "vkCreateFence");
}

void Device::Impl::chooseMemoryTypes() {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(adapter.physical, &memory);
    // Host-visible types are always taken host-coherent, which every device has: no flushes anywhere.
    const VkMemoryPropertyFlags local = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    const VkMemoryPropertyFlags visible =
        VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    const VkMemoryPropertyFlags cached = VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    auto& types = memoryTypesOf;
    types[int(MemoryUse::Device)] = adapter.hostMemory ? memoryTypes(memory, local | visible, cached, 0)
                                                       : memoryTypes(memory, local, 0, visible | cached);
    types[int(MemoryUse::Upload)] = memoryTypes(memory, visible, local, adapter.hostMemory ? 0 : cached);
    types[int(MemoryUse::Readback)] = memoryTypes(memory, visible, cached, adapter.hostMemory ? 0 : local);
}

Device::Impl::~Impl() {
    if (!device) return;
    cache.reset();
    vkDestroyFence(device, fence, nullptr);
    vkDestroyCommandPool(device, commandPool, nullptr);
    pool.reset();
    vkDestroyDevice(device, nullptr);
}

Device::Device() : _impl(std::make_unique<Impl>()) {}

Device::~Device() {
    if (!_impl->device) return;
    vkDeviceWaitIdle(_impl->device);
    // Buffers free themselves through this object, so they go while it is whole.
    _impl->uploads.buffer = Buffer();
    _impl->readbacks.buffer = Buffer();
}

/// Leaves `pool` empty, with the reason in `error`, when there is no usable device.
void Device::Impl::create(const RendererOptions& options, std::string* error) {
    messages = options.messages ? options.messages : MessageSink(&toStandardError);
    instance = Instance::create(options.validation || environmentSays("HIPR_VALIDATION"), messages, error);
    if (!instance) return;
    const std::vector<Adapter> adapters = listAdapters(instance->handle());
    const Adapter* chosen = chooseAdapter(adapters, options.device, error);
    if (!chosen) return;
    adapter = *chosen;
    if (environmentSays("HIPR_NO_HOST_MEMORY")) adapter.hostMemory = false;
    createDevice();
    createCommands();
    chooseMemoryTypes();
    cache = std::make_unique<PipelineCache>(adapter.physical, device);
    pool = std::make_unique<MemoryPool>(adapter.physical, device, adapter.memoryBudget, adapter.info.cpu);
}

std::unique_ptr<Device> Device::create(const RendererOptions& options, std::string* error) {
    std::unique_ptr<Device> self(new Device);
    Impl& d = *self->_impl;
    try {
        d.create(options, error);
    } catch (const std::exception& e) {
        const std::string& name = d.adapter.info.name;
        *error = (name.empty() ? "Vulkan" : "the Vulkan device '" + name + "'") +
                 " cannot be used: " + reasonOf(e);
    }
    if (!d.pool) return nullptr;
    return self;
}

const DeviceInfo& Device::info() const {
    return _impl->adapter.info;
}
const MessageSink& Device::messages() const {
    return _impl->messages;
}
bool Device::hostMemory() const {
    return _impl->adapter.hostMemory;
}
MemoryReport Device::memory() const {
    return _impl->pool->report();
}
uint64_t Device::reservedBytes() const {
    return _impl->pool->reservedBytes();
}
bool Device::validation() const {
    return _impl->instance->validation();
}
uint64_t Device::validationErrors() const {
    return _impl->instance->validationErrors();
}
VkDevice Device::handle() const {
    return _impl->device;
}
VkPhysicalDevice Device::physical() const {
    return _impl->adapter.physical;
}
VkPipelineCache Device::pipelineCache() const {
    return _impl->cache->handle();
}

Buffer Device::createBuffer(uint64_t bytes, MemoryUse use, const char* kind) {
    Impl& d = *_impl;
    Buffer buffer;
    buffer._device = this;
    buffer._bytes = std::max<uint64_t>(bytes, 16);

    auto info = vkStruct<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
    info.size = buffer._bytes;
    info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                 VK_BUFFER_USAGE_TRANSFER_DST_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                 VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    if (d.adapter.info.rayQuery)
        info.usage |= VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
                      VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
    std::optional<MemoryRange> range;
    if (buffer._bytes <= d.adapter.maxBufferBytes &&
        vkCreateBuffer(d.device, &info, nullptr, &buffer._buffer) == VK_SUCCESS) {
        VkMemoryRequirements need;
        vkGetBufferMemoryRequirements(d.device, buffer._buffer, &need);
        // Acceleration structures start at multiples of 256 bytes, and so may any buffer.
        need.alignment = std::max<VkDeviceSize>(need.alignment, 256);
        range = d.pool->allocate(need, d.memoryTypesOf[int(use)], kind);
    }
    if (!range) // the destructor of `buffer` cleans up
        throw OutOfMemory("out of device memory: " + std::to_string(buffer._bytes) + " bytes wanted (" +
                          kind + "), " + std::to_string(reservedBytes()) + " of " +
                          std::to_string(d.adapter.info.memoryBytes) + " bytes in use");
    buffer._range = *range;
    if (use != MemoryUse::Device || d.adapter.hostMemory) buffer._mapped = range->mapped;
    check(vkBindBufferMemory(d.device, buffer._buffer, range->memory, range->offset), "vkBindBufferMemory");
    auto address = vkStruct<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
    address.buffer = buffer._buffer;
    buffer._address = vkGetBufferDeviceAddress(d.device, &address);
    return buffer;
}

void Device::free(Buffer& buffer) {
    vkDestroyBuffer(_impl->device, buffer._buffer, nullptr);
    if (buffer._range.owner) _impl->pool->free(buffer._range);
}

Buffer::~Buffer() {
    if (_device) _device->free(*this);
}

void Buffer::swap(Buffer& o) noexcept {
    std::swap(_device, o._device);
    std::swap(_buffer, o._buffer);
    std::swap(_address, o._address);
    std::swap(_bytes, o._bytes);
    std::swap(_mapped, o._mapped);
    std::swap(_range, o._range);
}

/// Calls transfer(staging, done, part) for one part after the other of `bytes`.
template <class Transfer> void Device::throughStaging(bool up, uint64_t bytes, Transfer&& transfer) {
    Impl::Staging& staging = up ? _impl->uploads : _impl->readbacks;
    std::lock_guard lock(staging.mutex);
    if (!staging.buffer) staging.buffer = createBuffer(StagingBytes, staging.use, "staging");
    for (uint64_t done = 0, part; done < bytes; done += part) {
        part = std::min(bytes - done, StagingBytes);
        transfer(staging.buffer, done, part);
    }
}

void Device::copy(const Buffer& from, const Buffer& to, const VkBufferCopy& region) {
    run([&](VkCommandBuffer cmd) { vkCmdCopyBuffer(cmd, from.handle(), to.handle(), 1, &region); });
}

void Device::upload(const Buffer& dst, const void* data, uint64_t bytes, uint64_t offset) {
    if (bytes == 0) return; // memcpy wants pointers even then
    if (dst.mapped()) {
        std::memcpy(dst.mapped<char>() + offset, data, bytes);
        return;
    }
    throughStaging(true, bytes, [&](const Buffer& staging, uint64_t done, uint64_t part) {
        std::memcpy(staging.mapped(), static_cast<const char*>(data) + done, part);
        copy(staging, dst, {0, offset + done, part});
    });
}

void Device::download(const Buffer& src, void* data, uint64_t bytes, uint64_t offset) {
    if (bytes == 0) return;
    if (src.mapped()) {
        std::memcpy(data, src.mapped<char>() + offset, bytes);
        return;
    }
    throughStaging(false, bytes, [&](const Buffer& staging, uint64_t done, uint64_t part) {
        copy(src, staging, {offset + done, 0, part});
        std::memcpy(static_cast<char*>(data) + done, staging.mapped(), part);
    });
}

void Device::Impl::submit() {
    auto submit = vkStruct<VkSubmitInfo>(VK_STRUCTURE_TYPE_SUBMIT_INFO);
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(queue, 1, &submit, fence), "vkQueueSubmit");
    if (vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX) == VK_SUCCESS &&
        vkResetFences(device, 1, &fence) == VK_SUCCESS)
        return;
    // The work may go on, and the caller is about to free what it reads.
    vkDeviceWaitIdle(device);
    lost = true;
    throw DeviceLost();
}

void Device::run(const std::function<void(VkCommandBuffer)>& record) {
    Impl& d = *_impl;
    std::lock_guard lock(d.submitMutex);
    if (d.lost) throw DeviceLost();
    auto begin = vkStruct<VkCommandBufferBeginInfo>(VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO);
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(d.commands, &begin), "vkBeginCommandBuffer");
    try {
        record(d.commands);
    } catch (...) {
        vkResetCommandBuffer(d.commands, 0);
        throw;
    }
    auto toHost = vkStruct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    toHost.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    toHost.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(d.commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &toHost, 0, nullptr, 0, nullptr);
    const VkResult ended = vkEndCommandBuffer(d.commands);
    if (ended != VK_SUCCESS) vkResetCommandBuffer(d.commands, 0); // or the next recording could not begin
    check(ended, "vkEndCommandBuffer");
    d.submit();
}

void computeBarrier(VkCommandBuffer cmd) {
    auto barrier = vkStruct<VkMemoryBarrier>(VK_STRUCTURE_TYPE_MEMORY_BARRIER);
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT | VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_SHADER_READ_BIT | VK_ACCESS_SHADER_WRITE_BIT |
                            VK_ACCESS_TRANSFER_READ_BIT | VK_ACCESS_TRANSFER_WRITE_BIT |
                            VK_ACCESS_INDIRECT_COMMAND_READ_BIT;
    const VkPipelineStageFlags work = VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_TRANSFER_BIT;
    vkCmdPipelineBarrier(cmd, work, work | VK_PIPELINE_STAGE_DRAW_INDIRECT_BIT, 0, 1, &barrier, 0, nullptr, 0,
                         nullptr);
}

} // namespace hipr
