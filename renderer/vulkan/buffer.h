/// @file buffer.h
/// A range of device memory with a device address.
#pragma once

#include <cstdint>
#include <utility>

#include <vulkan/vulkan.h>

#include "renderer/vulkan/memory.h"

namespace hipr {

class Device;

/// Owns a storage buffer. Move-only; freed on destruction (the owner makes sure no submission still reads
/// it). Every buffer can be a storage, transfer, indirect and device-address buffer, and an
/// acceleration-structure input.
class Buffer {
public:
    Buffer() = default;
    Buffer(Buffer&& o) noexcept { swap(o); }
    Buffer& operator=(Buffer&& o) noexcept {
        Buffer(std::move(o)).swap(*this);
        return *this;
    }
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer();

    explicit operator bool() const { return _buffer != VK_NULL_HANDLE; }
    VkBuffer handle() const { return _buffer; }
    VkDeviceAddress address() const { return _address; }
    uint64_t bytes() const { return _bytes; }

    /// Host pointer; null unless the device's memory is host-visible (Device::hostMemory()) or the buffer was
    /// made with MemoryUse::Readback or Upload.
    template <class T = void> T* mapped() const { return static_cast<T*>(_mapped); }

    void swap(Buffer& o) noexcept;

private:
    friend class Device;
    Device* _device = nullptr;
    VkBuffer _buffer = VK_NULL_HANDLE;
    VkDeviceAddress _address = 0;
    uint64_t _bytes = 0;
    void* _mapped = nullptr;
    MemoryRange _range;
};

} // namespace hipr
