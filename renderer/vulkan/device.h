/// @file device.h
/// One logical Vulkan 1.2 device: memory, one compute queue, uploads.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "renderer/api/renderer.h"
#include "renderer/vulkan/buffer.h"
#include "renderer/vulkan/result.h"

namespace hipr {

enum class MemoryUse {
    Device,   ///< fastest for kernels; host-visible too when hostMemory()
    Upload,   ///< written by the host, read by kernels
    Readback, ///< written by kernels, read by the host
};

/// Owns instance, device, queue and memory. Not copyable. Thread-safe; submissions of several threads queue
/// up. Outlives its buffers and kernels.
class Device {
public:
    /// Returns null with the reason in `error`. `selector` as RendererOptions::device.
    static std::unique_ptr<Device> create(const RendererOptions& options, std::string* error);
    ~Device();

    const DeviceInfo& info() const;
    const MessageSink& messages() const;

    /// True when every buffer is mapped and host writes are visible to kernels without a copy (CPU devices,
    /// UMA). HIPR_NO_HOST_MEMORY=1 makes it false, so that any machine can run the code for discrete GPUs.
    bool hostMemory() const;

    /// Allocates; contents are undefined; addresses are multiples of 256. `kind` names the row of
    /// MemoryReport the bytes count under and must be a literal. Sizes of 0 are rounded up to 16. Throws
    /// OutOfMemory, which says what was wanted, when device memory is exhausted; the device stays usable.
    Buffer createBuffer(uint64_t bytes, MemoryUse use, const char* kind);

    /// Copies host data into a buffer; direct when mapped, else through a staging buffer (blocking).
    void upload(const Buffer& dst, const void* data, uint64_t bytes, uint64_t offset = 0);
    void download(const Buffer& src, void* data, uint64_t bytes, uint64_t offset = 0);

    /// createBuffer + upload.
    template <class T> Buffer createFrom(const T* data, size_t count, const char* kind) {
        Buffer b = createBuffer(count * sizeof(T), MemoryUse::Device, kind);
        if (count) upload(b, data, count * sizeof(T));
        return b;
    }

    /// Records with `record`, submits and waits. What kernels and transfers wrote is visible to the host
    /// afterwards. Throws OutOfMemory when nothing could be submitted, and DeviceLost, from then on always,
    /// when what was submitted did not end well. `record` must not use the device's blocking calls.
    void run(const std::function<void(VkCommandBuffer)>& record);

    /// Bytes of living buffers by kind, largest first.
    MemoryReport memory() const;
    /// Bytes taken from the driver, the unused parts of memory blocks included.
    uint64_t reservedBytes() const;

    /// Whether the validation layer is at work, and how often it complained so far.
    bool validation() const;
    uint64_t validationErrors() const;

    VkDevice handle() const;
    VkPhysicalDevice physical() const;
    VkPipelineCache pipelineCache() const;

private:
    friend class Buffer;
    Device();
    void free(Buffer& buffer);
    template <class Transfer> void throughStaging(bool up, uint64_t bytes, Transfer&& transfer);
    void copy(const Buffer& from, const Buffer& to, const VkBufferCopy& region);
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

/// A global memory barrier between compute dispatches, transfers and indirect reads of one command buffer.
void computeBarrier(VkCommandBuffer cmd);

} // namespace hipr
