/// @file memory.h
/// Device memory: few large driver allocations, divided among many buffers.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <vulkan/vulkan.h>

#include "renderer/api/renderer.h"
#include "renderer/vulkan/block.h"

namespace hipr {

/// A piece of device memory; plain data, owned by whoever got it from MemoryPool::allocate().
struct MemoryRange {
    VkDeviceMemory memory = VK_NULL_HANDLE;
    uint64_t offset = 0, bytes = 0;
    void* mapped = nullptr; ///< host address of `offset`; null in memory the host cannot see
    uint64_t owner = 0;     ///< the pool's own bookkeeping
};

/// Hands out ranges of device memory. Blocks of 64 MiB (less on small heaps) per memory type are divided
/// first-fit; a request of half a block or more gets a driver allocation of its own. Host-visible memory
/// stays mapped. All methods are thread-safe.
class MemoryPool {
public:
    MemoryPool(VkPhysicalDevice physical, VkDevice device, bool memoryBudget, bool cpu);
    MemoryPool(const MemoryPool&) = delete;
    MemoryPool& operator=(const MemoryPool&) = delete;
    ~MemoryPool();

    /// Tries the memory types in order; nullopt when none has room.
    std::optional<MemoryRange> allocate(const VkMemoryRequirements& need, const std::vector<uint32_t>& types,
                                        const char* kind);
    void free(const MemoryRange& range);

    /// Bytes in use by kind, largest first.
    MemoryReport report() const;
    /// Bytes taken from the driver, the unused parts of blocks included.
    uint64_t reservedBytes() const;

private:
    struct Chunk; ///< one driver allocation
    struct Owner {
        Chunk* chunk = nullptr;
        std::string kind;
    };

    std::optional<MemoryRange> place(uint32_t type, const VkMemoryRequirements& need);
    std::unique_ptr<Chunk> createChunk(uint32_t type, uint64_t bytes);
    void destroyChunk(const Chunk* chunk);
    bool heapHasRoom(uint32_t heap, uint64_t bytes) const;
    MemoryRange rangeOf(Chunk& chunk, uint64_t offset, uint64_t bytes) const;

    VkPhysicalDevice _physical;
    VkDevice _device;
    bool _memoryBudget, _cpu;
    VkPhysicalDeviceMemoryProperties _properties{};
    uint64_t _maxAllocations = 0;

    mutable std::mutex _mutex;
    std::vector<std::unique_ptr<Chunk>> _chunks;
    std::vector<uint64_t> _heapBytes; ///< taken from the driver, by heap
    std::map<uint64_t, Owner> _owners;
    uint64_t _lastOwner = 0;
    std::map<std::string, uint64_t> _bytesByKind;
};

/// Memory types with all of `required`, those with more of `preferred` and then fewer of `avoided` first.
std::vector<uint32_t> memoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                  VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                                  VkMemoryPropertyFlags avoided);

} // namespace hipr
