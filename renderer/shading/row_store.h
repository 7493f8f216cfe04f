/// @file row_store.h
/// Rows of bytes on the device, in slots of powers of two, so that a material takes what it needs.
#pragma once

#include <map>
#include <vector>

#include "renderer/vulkan/device.h"

namespace hipr {

struct RowSlot {
    uint64_t bytes = 0; ///< 0: none
    uint32_t number = 0;
};

/// Rows of any size. A slot given back is used again by a row of its size; buffers grow by doubling.
class RowStore {
public:
    /// A slot for `bytes`; `old` itself if it fits, else that is given back.
    RowSlot take(uint64_t bytes, RowSlot old = {});
    void giveBack(RowSlot slot);

    /// Makes room for all slots taken. Returns whether all rows are to be written anew.
    bool grow(Device& device);

    /// Where a row is. Valid after grow().
    uint64_t address(RowSlot slot) const;
    /// Writes the beginning of a row.
    void write(Device& device, RowSlot slot, const void* data, uint64_t bytes) const;

private:
    struct Size {
        uint32_t used = 0, capacity = 0; ///< slots
        std::vector<uint32_t> free;
        Buffer buffer;
    };
    std::map<uint64_t, Size> _sizes; ///< by bytes of a slot
};

/// The smallest doubling of `capacity` (0: 64) that holds `least`.
uint32_t doubledCapacity(uint32_t capacity, uint32_t least);

} // namespace hipr
