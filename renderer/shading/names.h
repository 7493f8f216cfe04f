/// @file names.h
/// Primvar names as small numbers, so that kernels compare integers.
#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <unordered_map>

namespace hipr {

/// Interns names for PrimvarRecord::name and InputNode::primvar. An id never changes or goes away;
/// thread-safe.
class NameTable {
public:
    /// Ids of names that kernels know by themselves; interned by the constructor in this order.
    enum Known : uint32_t { DisplayColor, DisplayOpacity, St };

    NameTable();
    uint32_t intern(const std::string& name);

private:
    std::mutex _mutex;
    std::unordered_map<std::string, uint32_t> _ids;
};

} // namespace hipr
