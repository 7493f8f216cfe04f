#include "renderer/shading/row_store.h"

namespace hipr {

namespace {

constexpr uint64_t SmallestSlot = 256;

uint64_t slotBytes(uint64_t bytes) {
    uint64_t size = SmallestSlot;
    while (size < bytes)
        size *= 2;
    return size;
}

} // namespace

uint32_t doubledCapacity(uint32_t capacity, uint32_t least) {
    while (capacity < least)
        capacity = capacity ? capacity * 2 : 64;
    return capacity;
}

RowSlot RowStore::take(uint64_t bytes, RowSlot old) {
    bytes = slotBytes(bytes);
    if (old.bytes == bytes) return old;
    giveBack(old);
    Size& size = _sizes[bytes];
    if (size.free.empty()) return {bytes, size.used++};
    const uint32_t number = size.free.back();
    size.free.pop_back();
    return {bytes, number};
}

void RowStore::giveBack(RowSlot slot) {
    if (slot.bytes) _sizes[slot.bytes].free.push_back(slot.number);
}

bool RowStore::grow(Device& device) {
    bool any = false;
    for (auto& [bytes, size] : _sizes) {
        if (size.used <= size.capacity) continue;
        const uint32_t capacity = doubledCapacity(size.capacity, size.used);
        size.buffer = device.createBuffer(capacity * bytes, MemoryUse::Device, "materials");
        size.capacity = capacity;
        any = true;
    }
    return any;
}

uint64_t RowStore::address(RowSlot slot) const {
    return _sizes.at(slot.bytes).buffer.address() + slot.number * slot.bytes;
}

void RowStore::write(Device& device, RowSlot slot, const void* data, uint64_t bytes) const {
    device.upload(_sizes.at(slot.bytes).buffer, data, bytes, slot.number * slot.bytes);
}

} // namespace hipr
