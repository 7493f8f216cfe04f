/// @file allocation_faults.h
/// operator new that fails on demand, for programs that link allocation_faults.cpp. Only what the program's
/// own code asks for can fail: shared libraries (the driver, its compiler, Embree) are not expected to
/// survive it.
#pragma once

#include <cstdint>
#include <vector>

namespace hipr::test {

/// A place in the code that allocates.
struct AllocationSite {
    uintptr_t address = 0; ///< to be told apart, and for addr2line: relative to the start of the program
    uint64_t count = 0;
};

/// While it lives, counts the allocations of every place, and makes the n-th (from 1) of one place throw.
class AllocationFault {
public:
    explicit AllocationFault(uintptr_t address = 0, uint64_t n = 0);
    ~AllocationFault();
    AllocationFault(const AllocationFault&) = delete;
    AllocationFault& operator=(const AllocationFault&) = delete;

    std::vector<AllocationSite> sites() const;
    bool failed() const;
};

/// While it lives, allocations of all threads are counted and may fail.
class Allocating {
public:
    Allocating();
    ~Allocating();
    Allocating(const Allocating&) = delete;
    Allocating& operator=(const Allocating&) = delete;
};

/// While it lives, allocations of this thread are left alone.
class NotAllocating {
public:
    NotAllocating();
    ~NotAllocating();
    NotAllocating(const NotAllocating&) = delete;
    NotAllocating& operator=(const NotAllocating&) = delete;
};

} // namespace hipr::test
