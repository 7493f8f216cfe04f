/// @file instance.h
/// The Vulkan instance and, on request, the validation layer.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include <vulkan/vulkan.h>

#include "renderer/api/types.h"

namespace hipr {

class Instance {
public:
    /// Returns null with the reason in `error`. `validation` asks for VK_LAYER_KHRONOS_validation: its
    /// messages go to `messages` as errors; when the layer is not installed there is one warning and the
    /// instance works without it.
    static std::unique_ptr<Instance> create(bool validation, const MessageSink& messages, std::string* error);
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;
    ~Instance();

    VkInstance handle() const { return _instance; }
    /// Whether the validation layer is at work.
    bool validation() const { return _messenger != VK_NULL_HANDLE; }
    uint64_t validationErrors() const { return _validationErrors.load(); }

private:
    explicit Instance(const MessageSink& messages) : _messages(messages) {}
    static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                                    const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                    void* self);

    MessageSink _messages;
    VkInstance _instance = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT _messenger = VK_NULL_HANDLE;
    std::atomic<uint64_t> _validationErrors{0};
};

} // namespace hipr
