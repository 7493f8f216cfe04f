/// @file vulkan_faults.h
/// A Vulkan driver that fails on demand. A program that links vulkan_faults.cpp has these functions between
/// the renderer and the Vulkan loader: nothing in the renderer knows of them, and a call that is to fail
/// never reaches the driver.
#pragma once

#include <cstdint>

#include <vulkan/vulkan.h>

namespace hipr::test {

enum class Fault {
    OutOfMemory, ///< one call that makes or records something; the next calls succeed again
    NoMemory,    ///< such a call and all such calls after it
    DeviceLost,  ///< a submission, or the wait for one, and all after it
};

/// While it lives, the n-th call (from 1) that may fail in this way does. Only one at a time; thread-safe.
class VulkanFault {
public:
    VulkanFault(Fault fault, uint64_t n);
    ~VulkanFault();
    VulkanFault(const VulkanFault&) = delete;
    VulkanFault& operator=(const VulkanFault&) = delete;

    /// Calls so far that might have failed: with n = 0 nothing fails, and this says how many there are.
    uint64_t calls() const;
    /// The function that failed first, or null.
    const char* failed() const;
};

} // namespace hipr::test
