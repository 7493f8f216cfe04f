/// @file block.h
/// Divides a span of offsets into ranges. Pure bookkeeping: no memory, no Vulkan, no locks.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace hipr {

/// First fit over a free list kept in offset order; neighbours merge when a range returns, so that a block
/// whose ranges are all returned is one free range again.
class Block {
public:
    explicit Block(uint64_t bytes);

    /// The offset of `bytes` free bytes at a multiple of `alignment` (a power of two), or nothing when they
    /// do not fit. `bytes` must not be 0.
    std::optional<uint64_t> allocate(uint64_t bytes, uint64_t alignment);
    /// Returns a range exactly as allocate() gave it. Never fails.
    void free(uint64_t offset, uint64_t bytes);

    uint64_t bytes() const { return _bytes; }
    uint64_t freeBytes() const { return _freeBytes; }
    bool unused() const { return _freeBytes == _bytes; }
    size_t freeRanges() const { return _free.size(); }

private:
    uint64_t _bytes, _freeBytes;
    using Ranges = std::map<uint64_t, uint64_t>; ///< offset -> bytes
    Ranges _free;                                ///< no two of them touch
    Ranges _used;                                ///< so that free() has a place for each and cannot fail
};

} // namespace hipr
