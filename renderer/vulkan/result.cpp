#include "renderer/vulkan/result.h"

#include <typeinfo>

namespace hipr {

const char* resultName(VkResult result) {
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
        return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "VK_ERROR_TOO_MANY_OBJECTS";
    default:
        return "an unexpected result";
    }
}

void check(VkResult result, const char* what) {
    if (result >= 0) return;
    if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost();
    if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY)
        throw OutOfMemory(std::string("out of memory in the Vulkan driver (") + what + ": " +
                          resultName(result) + ")");
    throw std::runtime_error(std::string(what) + " failed: " + resultName(result) + " (" +
                             std::to_string(result) + ")");
}

const char* reasonOf(const std::exception& e) noexcept {
    return typeid(e) == typeid(std::bad_alloc) ? "out of memory" : e.what();
}

} // namespace hipr
