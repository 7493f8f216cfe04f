#include "renderer/vulkan/block.h"

#include <iterator>

namespace hipr {

Block::Block(uint64_t bytes) : _bytes(bytes), _freeBytes(bytes) {
    if (bytes) _free.emplace(0, bytes);
}

std::optional<uint64_t> Block::allocate(uint64_t bytes, uint64_t alignment) {
    for (auto it = _free.begin(); it != _free.end(); ++it) {
        const uint64_t begin = it->first, end = begin + it->second;
        const uint64_t offset = (begin + alignment - 1) & ~(alignment - 1);
        if (offset >= end || end - offset < bytes) continue;
        if (offset > begin)
            it->second = offset - begin; // the alignment gap stays free
        else
            _free.erase(it);
        if (offset + bytes < end) _free.emplace(offset + bytes, end - offset - bytes);
        _freeBytes -= bytes;
        return offset;
    }
    return std::nullopt;
}

void Block::free(uint64_t offset, uint64_t bytes) {
    _freeBytes += bytes;
    auto next = _free.lower_bound(offset);
    if (next != _free.end() && next->first == offset + bytes) {
        bytes += next->second;
        next = _free.erase(next);
    }
    if (next != _free.begin()) {
        auto previous = std::prev(next);
        if (previous->first + previous->second == offset) {
            previous->second += bytes;
            return;
        }
    }
    _free.emplace(offset, bytes);
}

} // namespace hipr
