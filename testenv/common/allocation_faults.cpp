#include "testenv/common/allocation_faults.h"

#include <atomic>
#include <cstdlib>
#include <new>

extern char __executable_start, etext; // the linker's

namespace hipr::test {
namespace {

/// A table without a lock that allocates nothing itself.
struct Slot {
    std::atomic<uintptr_t> address{0};
    std::atomic<uint64_t> count{0};
};
constexpr size_t Slots = 1 << 14;
Slot table[Slots];

std::atomic<bool> armed{false}, counting{false}, hasFailed{false};
std::atomic<uintptr_t> failAddress{0};
std::atomic<uint64_t> failCount{0};
thread_local bool exempt = false;

Slot& slotOf(uintptr_t address) {
    for (size_t i = (address >> 2) % Slots;; i = (i + 1) % Slots) {
        uintptr_t owner = 0;
        if (table[i].address.compare_exchange_strong(owner, address) || owner == address) return table[i];
    }
}

bool mustFail(void* caller) {
    if (!armed || !counting || exempt || caller < &__executable_start || caller >= &etext) return false;
    const uintptr_t address = uintptr_t(caller) - uintptr_t(&__executable_start);
    const uint64_t count = ++slotOf(address).count;
    if (address != failAddress || count != failCount) return false;
    hasFailed = true;
    return true;
}

void* allocate(size_t bytes, void* caller) {
    void* const memory = mustFail(caller) ? nullptr : std::malloc(bytes ? bytes : 1);
    if (!memory) throw std::bad_alloc();
    return memory;
}

} // namespace

AllocationFault::AllocationFault(uintptr_t address, uint64_t n) {
    for (Slot& slot : table) {
        slot.address = 0;
        slot.count = 0;
    }
    hasFailed = false;
    failAddress = address;
    failCount = n;
    counting = true;
}

AllocationFault::~AllocationFault() {
    counting = false;
}

std::vector<AllocationSite> AllocationFault::sites() const {
    std::vector<AllocationSite> sites;
    for (const Slot& slot : table)
        if (slot.address) sites.push_back({slot.address, slot.count});
    return sites;
}

bool AllocationFault::failed() const {
    return hasFailed;
}

Allocating::Allocating() {
    armed = true;
}

Allocating::~Allocating() {
    armed = false;
}

NotAllocating::NotAllocating() {
    exempt = true;
}

NotAllocating::~NotAllocating() {
    exempt = false;
}

} // namespace hipr::test

void* operator new(size_t bytes) {
    return hipr::test::allocate(bytes, __builtin_return_address(0));
}

void* operator new[](size_t bytes) {
    return hipr::test::allocate(bytes, __builtin_return_address(0));
}

void operator delete(void* memory) noexcept {
    std::free(memory);
}

void operator delete[](void* memory) noexcept {
    std::free(memory);
}

void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}

void operator delete[](void* memory, size_t) noexcept {
    std::free(memory);
}

void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
    return std::malloc(bytes ? bytes : 1);
}

void* operator new[](size_t bytes, const std::nothrow_t&) noexcept {
    return std::malloc(bytes ? bytes : 1);
}

void operator delete(void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}

void operator delete[](void* memory, const std::nothrow_t&) noexcept {
    std::free(memory);
}
