#include "renderer/vulkan/memory.h"

#include <algorithm>
#include <bitset>

#include "renderer/vulkan/structs.h"

namespace hipr {

namespace {
constexpr uint64_t BlockBytes = 64ull << 20;

int count(VkMemoryPropertyFlags flags) {
    return int(std::bitset<32>(flags).count());
}
} // namespace

struct MemoryPool::Chunk {
    Chunk(uint32_t type, uint64_t bytes) : type(type), block(bytes) {}
    uint32_t type;
    Block block;
    bool dedicated = false;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    char* mapped = nullptr;
};

std::vector<uint32_t> memoryTypes(const VkPhysicalDeviceMemoryProperties& properties,
                                  VkMemoryPropertyFlags required, VkMemoryPropertyFlags preferred,
                                  VkMemoryPropertyFlags avoided) {
    std::vector<uint32_t> types;
    const VkMemoryPropertyFlags special =
        VK_MEMORY_PROPERTY_PROTECTED_BIT | VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT |
        VK_MEMORY_PROPERTY_DEVICE_COHERENT_BIT_AMD | VK_MEMORY_PROPERTY_DEVICE_UNCACHED_BIT_AMD;
    for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
        const VkMemoryPropertyFlags flags = properties.memoryTypes[i].propertyFlags;
        if ((flags & required) == required && !(flags & special)) types.push_back(i);
    }
    std::stable_sort(types.begin(), types.end(), [&](uint32_t a, uint32_t b) {
        const VkMemoryPropertyFlags fa = properties.memoryTypes[a].propertyFlags;
        const VkMemoryPropertyFlags fb = properties.memoryTypes[b].propertyFlags;
        if (count(fa & preferred) != count(fb & preferred))
            return count(fa & preferred) > count(fb & preferred);
        return count(fa & avoided) < count(fb & avoided);
    });
    return types;
}

MemoryPool::MemoryPool(VkPhysicalDevice physical, VkDevice device, bool memoryBudget, bool cpu)
    : _physical(physical), _device(device), _memoryBudget(memoryBudget), _cpu(cpu) {
    vkGetPhysicalDeviceMemoryProperties(physical, &_properties);
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    _maxAllocations = properties.limits.maxMemoryAllocationCount;
    _heapBytes.resize(_properties.memoryHeapCount);
}

MemoryPool::~MemoryPool() {
    for (const auto& chunk : _chunks)
        vkFreeMemory(_device, chunk->memory, nullptr);
}

bool MemoryPool::heapHasRoom(uint32_t heap, uint64_t bytes) const {
    const uint64_t size = _properties.memoryHeaps[heap].size;
    if (bytes > size || _heapBytes[heap] > size - bytes) return false;
    if (!_memoryBudget || !_cpu) return true; // the driver of a real device refuses by itself
    // A CPU device hands out host pages that do not exist yet: the system would kill the process on first
    // touch.
    auto budget = vkStruct<VkPhysicalDeviceMemoryBudgetPropertiesEXT>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT);
    auto properties =
        vkStruct<VkPhysicalDeviceMemoryProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2);
    properties.pNext = &budget;
    vkGetPhysicalDeviceMemoryProperties2(_physical, &properties);
    const uint64_t used = budget.heapUsage[heap], limit = budget.heapBudget[heap];
    return used < limit && bytes <= limit - used;
}

std::unique_ptr<MemoryPool::Chunk> MemoryPool::createChunk(uint32_t type, uint64_t bytes) {
    const uint32_t heap = _properties.memoryTypes[type].heapIndex;
    if (_chunks.size() >= _maxAllocations || !heapHasRoom(heap, bytes)) return nullptr;

    auto flags = vkStruct<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
    flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
    auto info = vkStruct<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.pNext = &flags;
    info.allocationSize = bytes;
    info.memoryTypeIndex = type;
    auto chunk = std::make_unique<Chunk>(type, bytes);
    if (vkAllocateMemory(_device, &info, nullptr, &chunk->memory) != VK_SUCCESS) return nullptr;
    if (_properties.memoryTypes[type].propertyFlags & VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT) {
        void* mapped = nullptr;
        if (vkMapMemory(_device, chunk->memory, 0, VK_WHOLE_SIZE, 0, &mapped) != VK_SUCCESS) {
            vkFreeMemory(_device, chunk->memory, nullptr);
            return nullptr;
        }
        chunk->mapped = static_cast<char*>(mapped);
    }
    _heapBytes[heap] += bytes;
    return chunk;
}

void MemoryPool::destroyChunk(const Chunk* chunk) {
    vkFreeMemory(_device, chunk->memory, nullptr); // unmaps as well
    _heapBytes[_properties.memoryTypes[chunk->type].heapIndex] -= chunk->block.bytes();
    _chunks.erase(
        std::find_if(_chunks.begin(), _chunks.end(), [&](const auto& c) { return c.get() == chunk; }));
}

MemoryRange MemoryPool::rangeOf(Chunk& chunk, uint64_t offset, uint64_t bytes) const {
    return {chunk.memory, offset, bytes, chunk.mapped ? chunk.mapped + offset : nullptr, 0};
}

std::optional<MemoryRange> MemoryPool::place(uint32_t type, const VkMemoryRequirements& need) {
    const uint64_t heapBytes = _properties.memoryHeaps[_properties.memoryTypes[type].heapIndex].size;
    const uint64_t blockBytes =
        std::min(BlockBytes, std::max<uint64_t>(heapBytes / 16, 1 << 20) & ~uint64_t(255));
    const bool dedicated = need.size >= blockBytes / 2;

    auto placeIn = [&](Chunk& chunk) -> std::optional<MemoryRange> {
        const auto offset = chunk.block.allocate(need.size, need.alignment);
        if (!offset) return std::nullopt;
        MemoryRange range = rangeOf(chunk, *offset, need.size);
        range.owner = ++_lastOwner;
        _owners[range.owner].chunk = &chunk;
        return range;
    };
    if (!dedicated) {
        for (const auto& chunk : _chunks)
            if (chunk->type == type && !chunk->dedicated)
                if (auto range = placeIn(*chunk)) return range;
    }
    _chunks.reserve(_chunks.size() + 1); // a chunk without a place in the list would never be freed
    std::unique_ptr<Chunk> chunk = dedicated ? nullptr : createChunk(type, blockBytes);
    if (!chunk) { // when a whole block does not fit any more, the request alone may
        chunk = createChunk(type, need.size);
        if (!chunk) return std::nullopt;
        chunk->dedicated = true;
    }
    _chunks.push_back(std::move(chunk));
    return placeIn(*_chunks.back());
}

std::optional<MemoryRange> MemoryPool::allocate(const VkMemoryRequirements& need,
                                                const std::vector<uint32_t>& types, const char* kind) {
    std::lock_guard lock(_mutex);
    for (const uint32_t type : types) {
        if (!(need.memoryTypeBits & (1u << type))) continue;
        if (auto range = place(type, need)) {
            _owners[range->owner].kind = kind;
            _bytesByKind[kind] += range->bytes;
            return range;
        }
    }
    return std::nullopt;
}

void MemoryPool::free(const MemoryRange& range) {
    std::lock_guard lock(_mutex);
    const auto it = _owners.find(range.owner);
    Chunk* chunk = it->second.chunk;
    const auto row = _bytesByKind.find(it->second.kind);
    row->second -= range.bytes;
    if (row->second == 0) _bytesByKind.erase(row);
    _owners.erase(it);
    chunk->block.free(range.offset, range.bytes);
    if (!chunk->block.unused()) return;
    // One empty block per type stays, so that a buffer made and dropped in a loop does not go to the driver
    // each time.
    const bool another = std::any_of(_chunks.begin(), _chunks.end(), [&](const auto& c) {
        return c.get() != chunk && c->type == chunk->type && !c->dedicated && c->block.unused();
    });
    if (chunk->dedicated || another) destroyChunk(chunk);
}

MemoryReport MemoryPool::report() const {
    std::lock_guard lock(_mutex);
    MemoryReport report;
    for (const auto& [kind, bytes] : _bytesByKind)
        report.rows.push_back({kind, bytes});
    std::stable_sort(report.rows.begin(), report.rows.end(),
                     [](const auto& a, const auto& b) { return a.bytes > b.bytes; });
    return report;
}

uint64_t MemoryPool::reservedBytes() const {
    std::lock_guard lock(_mutex);
    uint64_t total = 0;
    for (const uint64_t bytes : _heapBytes)
        total += bytes;
    return total;
}

} // namespace hipr
