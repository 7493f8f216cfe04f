/// @file result.h
/// Turns Vulkan's result codes into exceptions.
#pragma once

#include <vulkan/vulkan.h>

namespace hipr {

/// Throws DeviceLost, std::bad_alloc or std::runtime_error ("<what> failed: <code>") unless `result` is a
/// success.
void check(VkResult result, const char* what);

/// "VK_ERROR_..." for the common codes, else the number.
const char* resultName(VkResult result);

} // namespace hipr
