#include "renderer/vulkan/adapter.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>

#include "renderer/vulkan/instance.h"
#include "renderer/vulkan/result.h"

namespace hipr {

namespace {

/// One feature: how to reach its flag, and whether the renderer can do without.
struct FeatureRow {
    const char* name;
    bool required;
    VkBool32& (*flag)(Features&);
};

const FeatureRow FeatureTable[] = {
    {"bufferDeviceAddress", true, [](Features& f) -> VkBool32& { return f.v12.bufferDeviceAddress; }},
    {"scalarBlockLayout", true, [](Features& f) -> VkBool32& { return f.v12.scalarBlockLayout; }},
    {"shaderInt64", true, [](Features& f) -> VkBool32& { return f.core.features.shaderInt64; }},
    {"shaderInt16", true, [](Features& f) -> VkBool32& { return f.core.features.shaderInt16; }},
    {"storageBuffer16BitAccess", true,
     [](Features& f) -> VkBool32& { return f.v11.storageBuffer16BitAccess; }},
    {"storageBuffer8BitAccess", true, [](Features& f) -> VkBool32& { return f.v12.storageBuffer8BitAccess; }},
    {"shaderInt8", true, [](Features& f) -> VkBool32& { return f.v12.shaderInt8; }},
    {"shaderFloat16", false, [](Features& f) -> VkBool32& { return f.v12.shaderFloat16; }},
    {"shaderBufferInt64Atomics", false,
     [](Features& f) -> VkBool32& { return f.v12.shaderBufferInt64Atomics; }},
    // A kernel is warmed before its acceleration structure exists.
    {"descriptorBindingPartiallyBound", false,
     [](Features& f) -> VkBool32& { return f.v12.descriptorBindingPartiallyBound; }},
    {"accelerationStructure", false,
     [](Features& f) -> VkBool32& { return f.accelerationStructure.accelerationStructure; }},
    {"rayQuery", false, [](Features& f) -> VkBool32& { return f.rayQuery.rayQuery; }},
};

bool hasExtension(const std::vector<VkExtensionProperties>& extensions, const char* name) {
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
        return std::strcmp(e.extensionName, name) == 0;
    });
}

std::vector<VkExtensionProperties> extensionsOf(VkPhysicalDevice physical) {
    uint32_t count = 0;
    const char* const call = "vkEnumerateDeviceExtensionProperties";
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr), call);
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data()), call);
    extensions.resize(count);
    return extensions;
}

std::optional<uint32_t> computeQueueFamily(VkPhysicalDevice physical) {
    uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
    for (uint32_t i = 0; i < count; ++i)
        if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
    return std::nullopt;
}

/// True on CPU devices, and on integrated ones where one type of memory is everything at once. A discrete
/// device with a resizable BAR is host-visible as well, but host reads of it are far too slow to work on.
bool hasHostMemory(VkPhysicalDevice physical, VkPhysicalDeviceType type, uint64_t deviceBytes) {
    if (type != VK_PHYSICAL_DEVICE_TYPE_CPU && type != VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU) return false;
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    const VkMemoryPropertyFlags all = VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT |
                                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT |
                                      VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    for (uint32_t i = 0; i < memory.memoryTypeCount; ++i) {
        const VkMemoryType& t = memory.memoryTypes[i];
        if ((t.propertyFlags & all) == all && memory.memoryHeaps[t.heapIndex].size >= deviceBytes)
            return true;
    }
    return false;
}

uint64_t deviceLocalBytes(VkPhysicalDevice physical) {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical, &memory);
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < memory.memoryHeapCount; ++i)
        if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
            bytes = std::max<uint64_t>(bytes, memory.memoryHeaps[i].size);
    return bytes;
}

void appendMissing(DeviceInfo& info, const std::string& what) {
    info.missing += (info.missing.empty() ? "" : ", ") + what;
}

/// Fills what needs Vulkan 1.2 to ask.
void describeFeatures(Adapter& a) {
    const std::vector<VkExtensionProperties> extensions = extensionsOf(a.physical);
    a.memoryBudget = hasExtension(extensions, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    const bool rayExtensions = hasExtension(extensions, VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME) &&
                               hasExtension(extensions, VK_KHR_RAY_QUERY_EXTENSION_NAME) &&
                               hasExtension(extensions, VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME);
    Features features;
    features.link(rayExtensions);
    vkGetPhysicalDeviceFeatures2(a.physical, &features.core);
    for (const FeatureRow& row : FeatureTable)
        if (row.required && !row.flag(features)) appendMissing(a.info, row.name);
    a.info.rayQuery = features.accelerationStructure.accelerationStructure && features.rayQuery.rayQuery;

    auto driver =
        vkStruct<VkPhysicalDeviceDriverProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES);
    auto maintenance4 = vkStruct<VkPhysicalDeviceMaintenance4Properties>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_PROPERTIES);
    const bool hasBufferLimit = hasExtension(extensions, VK_KHR_MAINTENANCE_4_EXTENSION_NAME);
    if (hasBufferLimit) driver.pNext = &maintenance4;
    auto properties = vkStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &driver;
    vkGetPhysicalDeviceProperties2(a.physical, &properties);
    a.maxBufferBytes = hasBufferLimit ? maintenance4.maxBufferSize : UINT64_MAX;
    a.info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
}

Adapter describe(VkPhysicalDevice physical, uint32_t index) {
    Adapter a;
    a.physical = physical;
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    a.type = properties.deviceType;
    a.info.index = index;
    a.info.name = properties.deviceName;
    a.info.cpu = a.type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    a.info.memoryBytes = deviceLocalBytes(physical);
    if (properties.apiVersion < VK_API_VERSION_1_2)
        appendMissing(a.info, "Vulkan 1.2 (has " +
                                  std::to_string(VK_API_VERSION_MAJOR(properties.apiVersion)) + "." +
                                  std::to_string(VK_API_VERSION_MINOR(properties.apiVersion)) + ")");
    else
        describeFeatures(a);
    if (const auto family = computeQueueFamily(physical))
        a.queueFamily = *family;
    else
        appendMissing(a.info, "a compute queue");
    a.hostMemory = hasHostMemory(physical, a.type, a.info.memoryBytes);
    a.info.usable = a.info.missing.empty();
    return a;
}

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string nameList(const std::vector<Adapter>& adapters) {
    std::string text;
    for (const Adapter& a : adapters)
        text += (text.empty() ? "" : ", ") + std::to_string(a.info.index) + " = " + a.info.name;
    return text;
}

const Adapter* findAdapter(const std::vector<Adapter>& adapters, const std::string& selector) {
    const bool isIndex = selector.size() <= 4 && std::all_of(selector.begin(), selector.end(),
                                                             [](unsigned char c) { return std::isdigit(c); });
    for (const Adapter& a : adapters) {
        if (isIndex ? a.info.index == uint32_t(std::stoul(selector))
                    : lower(a.info.name).find(lower(selector)) != std::string::npos)
            return &a;
    }
    return nullptr;
}

int rank(VkPhysicalDeviceType type) {
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 1;
    default:
        return 0;
    }
}

} // namespace

void Features::link(bool withRayQuery) {
    core.pNext = &v11;
    v11.pNext = &v12;
    v12.pNext = withRayQuery ? static_cast<void*>(&accelerationStructure) : nullptr;
    accelerationStructure.pNext = &rayQuery;
}

std::vector<Adapter> listAdapters(VkInstance instance) {
    uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(instance, &count, nullptr), "vkEnumeratePhysicalDevices");
    std::vector<VkPhysicalDevice> physical(count);
    check(vkEnumeratePhysicalDevices(instance, &count, physical.data()), "vkEnumeratePhysicalDevices");
    std::vector<Adapter> adapters;
    for (uint32_t i = 0; i < count; ++i)
        adapters.push_back(describe(physical[i], i));
    return adapters;
}

const Adapter* chooseAdapter(const std::vector<Adapter>& adapters, const std::string& selector,
                             std::string* error) {
    if (adapters.empty()) {
        *error = "no Vulkan device found; on a machine without a GPU install Mesa's lavapipe (Debian: "
                 "mesa-vulkan-drivers)";
        return nullptr;
    }
    const char* environment = std::getenv("HIPR_DEVICE");
    const std::string wanted = !selector.empty() ? selector : environment ? environment : "";
    if (!wanted.empty()) {
        const Adapter* found = findAdapter(adapters, wanted);
        if (!found)
            *error = "no Vulkan device matches '" + wanted + "'; there are: " + nameList(adapters);
        else if (!found->info.usable)
            *error = "the Vulkan device '" + found->info.name + "' lacks " + found->info.missing;
        return found && found->info.usable ? found : nullptr;
    }
    const Adapter* best = nullptr;
    for (const Adapter& a : adapters)
        if (a.info.usable && (!best || rank(a.type) > rank(best->type))) best = &a;
    if (!best) {
        *error = "no usable Vulkan device:";
        for (const Adapter& a : adapters)
            *error += " '" + a.info.name + "' lacks " + a.info.missing + ";";
        error->pop_back();
    }
    return best;
}

Features featuresToEnable(const Adapter& adapter) {
    Features supported, enabled;
    supported.link(adapter.info.rayQuery);
    vkGetPhysicalDeviceFeatures2(adapter.physical, &supported.core);
    for (const FeatureRow& row : FeatureTable)
        row.flag(enabled) = row.flag(supported);
    return enabled;
}

std::vector<const char*> extensionsToEnable(const Adapter& adapter) {
    std::vector<const char*> names;
    if (adapter.info.rayQuery)
        names = {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME, VK_KHR_RAY_QUERY_EXTENSION_NAME,
                 VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME};
    if (adapter.memoryBudget) names.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
    return names;
}

std::vector<DeviceInfo> devices() {
    std::vector<DeviceInfo> infos;
    try {
        std::string error;
        const auto instance = Instance::create(
            false, [](Severity, const std::string&, const std::string&) {}, &error);
        if (!instance) return infos;
        for (const Adapter& a : listAdapters(instance->handle()))
            infos.push_back(a.info);
    } catch (const std::exception&) { // hosts ask while they load plugins: a broken driver is no device
    }
    return infos;
}

} // namespace hipr
