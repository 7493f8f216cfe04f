/// @file buffer_pack.h
/// Several arrays in one buffer: one allocation and one upload for everything that lives and dies together.
#pragma once

#include <cstring>
#include <vector>

#include "renderer/vulkan/device.h"

namespace hipr {

class BufferPack {
public:
    /// Appends an array and `padding` zero bytes. Returns its offset, a multiple of 16.
    template <class T> uint64_t add(const T* data, size_t count, size_t padding = 0) {
        const uint64_t offset = reserve(count * sizeof(T) + padding);
        if (count) std::memcpy(_bytes.data() + offset, data, count * sizeof(T));
        return offset;
    }
    template <class T> uint64_t add(const std::vector<T>& data, size_t padding = 0) {
        return add(data.data(), data.size(), padding);
    }
    /// Room for an array that needs the buffer's own address; filled by write().
    uint64_t reserve(uint64_t bytes) {
        const uint64_t offset = (_bytes.size() + 15) & ~uint64_t(15);
        _bytes.resize(offset + bytes);
        return offset;
    }
    template <class T> void write(uint64_t offset, const std::vector<T>& data) {
        if (!data.empty()) std::memcpy(_bytes.data() + offset, data.data(), data.size() * sizeof(T));
    }
    uint64_t bytes() const { return _bytes.size(); }
    void upload(Device& device, const Buffer& buffer) const {
        device.upload(buffer, _bytes.data(), _bytes.size());
    }

private:
    std::vector<std::byte> _bytes;
};

/// A table that grows by doubling and uploads only what changed.
class DeviceTable {
public:
    /// Makes room for `bytes`. Returns true when the contents must be uploaded again.
    bool reserve(Device& device, uint64_t bytes, const char* kind) {
        if (_buffer && bytes <= _buffer.bytes()) return false;
        _buffer = device.createBuffer(_buffer ? std::max(bytes, 2 * _buffer.bytes()) : bytes,
                                      MemoryUse::Device, kind);
        return true;
    }
    const Buffer& buffer() const { return _buffer; }
    VkDeviceAddress address() const { return _buffer ? _buffer.address() : 0; }

private:
    Buffer _buffer;
};

} // namespace hipr
