/// @file structs.h
/// Vulkan structs start with their type and zeros.
#pragma once

#include <vulkan/vulkan.h>

namespace hipr {

template <class T> T vkStruct(VkStructureType type) {
    T s{};
    s.sType = type;
    return s;
}

} // namespace hipr
