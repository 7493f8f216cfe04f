/// @file pipelinecache.h
/// A VkPipelineCache that outlives the process.
#pragma once

#include <filesystem>
#include <string>

#include <vulkan/vulkan.h>

namespace hipr {

/// Loaded from a file of its own per device and driver, and written back (whole or not at all) when it grew.
class PipelineCache {
public:
    PipelineCache(VkPhysicalDevice physical, VkDevice device);
    PipelineCache(const PipelineCache&) = delete;
    PipelineCache& operator=(const PipelineCache&) = delete;
    ~PipelineCache();

    VkPipelineCache handle() const { return _cache; }

private:
    void save() const;

    VkDevice _device;
    VkPipelineCache _cache = VK_NULL_HANDLE;
    std::filesystem::path _file; ///< empty: not kept
    size_t _loadedBytes = 0;
};

/// Cache data wrapped with a checksum, because drivers trust what they are given. Exposed for tests.
std::string packCache(const std::string& data);
/// The data, or empty when `file` is torn or altered.
std::string unpackCache(const std::string& file);

} // namespace hipr
