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
        Ranges used{{offset, bytes}}, rest; // all that may fail comes before all that changes
        if (offset + bytes < end) rest.emplace(offset + bytes, end - offset - bytes);
        _used.merge(used);
        _free.merge(rest);
        if (offset > begin)
            it->second = offset - begin; // the alignment gap stays free
        else
            _free.erase(it);
        _freeBytes -= bytes;
        return offset;
    }
    return std::nullopt;
}

void Block::free(uint64_t offset, uint64_t bytes) {
    _freeBytes += bytes;
    Ranges::node_type node = _used.extract(offset);
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
    node.mapped() = bytes;
    _free.insert(std::move(node));
}

} // namespace hipr
