/// @file result.h
/// Turns Vulkan's result codes into exceptions.
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include <vulkan/vulkan.h>

namespace hipr {

/// Thrown when the device is lost; the renderer reports it once and stops.
struct DeviceLost : std::runtime_error {
    DeviceLost() : std::runtime_error("the Vulkan device was lost") {}
};

/// Memory of the device or its driver is exhausted; what() says what it was wanted for.
class OutOfMemory : public std::bad_alloc {
public:
    explicit OutOfMemory(const std::string& text) : _text(text) {}
    const char* what() const noexcept override { return _text.what(); }

private:
    std::runtime_error _text; ///< a string that copies without throwing
};

/// Throws DeviceLost, OutOfMemory or std::runtime_error ("<what> failed: <code>") unless `result` is a
/// success.
void check(VkResult result, const char* what);

/// "VK_ERROR_..." for the common codes, else a phrase.
const char* resultName(VkResult result);

/// What to tell people about `e`: its text, or "out of memory" where the C++ library has none.
const char* reasonOf(const std::exception& e) noexcept;

} // namespace hipr
