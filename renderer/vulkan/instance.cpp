#include "renderer/vulkan/instance.h"

#include <cstring>
#include <vector>

#include "renderer/vulkan/cachefolder.h"
#include "renderer/vulkan/result.h"
#include "renderer/vulkan/structs.h"

namespace hipr {

namespace {

constexpr const char* ValidationLayer = "VK_LAYER_KHRONOS_validation";

bool layerInstalled(const char* name) {
    uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    layers.resize(count);
    for (const VkLayerProperties& layer : layers)
        if (std::strcmp(layer.layerName, name) == 0) return true;
    return false;
}

} // namespace

VKAPI_ATTR VkBool32 VKAPI_CALL Instance::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                   VkDebugUtilsMessageTypeFlagsEXT,
                                                   const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                   void* self) {
    Instance& instance = *static_cast<Instance*>(self);
    ++instance._validationErrors;
    instance._messages(Severity::Error, "Vulkan validation", data->pMessage ? data->pMessage : "");
    return VK_FALSE;
}

std::unique_ptr<Instance> Instance::create(bool validation, const MessageSink& messages, std::string* error) {
    setMesaCacheFolder();
    if (validation && !layerInstalled(ValidationLayer)) {
        messages(Severity::Warning, "Vulkan validation",
                 std::string(ValidationLayer) + " is not installed (Debian: vulkan-validationlayers); "
                                                "continuing without it");
        validation = false;
    }
    std::unique_ptr<Instance> self(new Instance(messages));

    auto messenger =
        vkStruct<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = &Instance::onMessage;
    messenger.pUserData = self.get();

    auto application = vkStruct<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.pApplicationName = application.pEngineName = "hipr";
    application.apiVersion = VK_API_VERSION_1_2;
    auto info = vkStruct<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    info.pApplicationInfo = &application;
    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    if (validation) {
        info.pNext = &messenger; // covers vkCreateInstance and vkDestroyInstance themselves
        info.enabledLayerCount = info.enabledExtensionCount = 1;
        info.ppEnabledLayerNames = &ValidationLayer;
        info.ppEnabledExtensionNames = &extension;
    }
    const VkResult result = vkCreateInstance(&info, nullptr, &self->_instance);
    if (result != VK_SUCCESS) {
        self->_instance = VK_NULL_HANDLE;
        *error = std::string("no Vulkan driver could be loaded (") + resultName(result) +
                 "); on a machine without a GPU install Mesa's lavapipe (Debian: mesa-vulkan-drivers)";
        return nullptr;
    }
    if (validation) {
        const auto createMessenger = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(self->_instance, "vkCreateDebugUtilsMessengerEXT"));
        createMessenger(self->_instance, &messenger, nullptr, &self->_messenger);
    }
    return self;
}

Instance::~Instance() {
    if (_messenger) {
        const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(_instance, "vkDestroyDebugUtilsMessengerEXT"));
        destroyMessenger(_instance, _messenger, nullptr);
    }
    if (_instance) vkDestroyInstance(_instance, nullptr);
}

} // namespace hipr
