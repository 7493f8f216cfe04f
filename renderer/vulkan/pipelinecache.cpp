#include "renderer/vulkan/pipelinecache.h"

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

#include <unistd.h>

#include "renderer/vulkan/cachefolder.h"
#include "renderer/vulkan/result.h"
#include "renderer/vulkan/structs.h"

namespace hipr {

namespace fs = std::filesystem;

namespace {

/// FNV-1a, 64 bits.
uint64_t checksum(const char* data, size_t bytes) {
    uint64_t hash = 14695981039346656037ull;
    for (size_t i = 0; i < bytes; ++i)
        hash = (hash ^ static_cast<unsigned char>(data[i])) * 1099511628211ull;
    return hash;
}

fs::path fileOf(VkPhysicalDevice physical) {
    const fs::path folder = cacheFolder("pipelines");
    if (folder.empty()) return {};
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    std::string name;
    for (const uint8_t byte : properties.pipelineCacheUUID) {
        char hex[3];
        std::snprintf(hex, sizeof hex, "%02x", byte);
        name += hex;
    }
    return folder / (name + ".bin");
}

} // namespace

std::string packCache(const std::string& data) {
    const uint64_t sum = checksum(data.data(), data.size());
    std::string file(reinterpret_cast<const char*>(&sum), sizeof sum);
    return file + data;
}

std::string unpackCache(const std::string& file) {
    uint64_t sum = 0;
    if (file.size() <= sizeof sum) return {};
    std::memcpy(&sum, file.data(), sizeof sum);
    const std::string data = file.substr(sizeof sum);
    return checksum(data.data(), data.size()) == sum ? data : std::string();
}

PipelineCache::PipelineCache(VkPhysicalDevice physical, VkDevice device)
    : _device(device), _file(fileOf(physical)) {
    std::string data;
    if (!_file.empty()) {
        std::ifstream in(_file, std::ios::binary);
        data = unpackCache(std::string(std::istreambuf_iterator<char>(in), {}));
    }
    auto info = vkStruct<VkPipelineCacheCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO);
    info.initialDataSize = data.size();
    info.pInitialData = data.data();
    check(vkCreatePipelineCache(device, &info, nullptr, &_cache), "vkCreatePipelineCache");
    _loadedBytes = data.size();
}

PipelineCache::~PipelineCache() {
    try {
        save();
    } catch (const std::exception&) { // no memory left to save with: the next start compiles again
    }
    vkDestroyPipelineCache(_device, _cache, nullptr);
}

void PipelineCache::save() const {
    size_t bytes = 0;
    if (_file.empty() || vkGetPipelineCacheData(_device, _cache, &bytes, nullptr) != VK_SUCCESS) return;
    if (bytes <= _loadedBytes) return;
    std::string data(bytes, '\0');
    if (vkGetPipelineCacheData(_device, _cache, &bytes, data.data()) != VK_SUCCESS) return;
    data.resize(bytes);
    // Another process may read or write the same file: a rename replaces it in one step.
    fs::path temporary = _file;
    temporary += "." + std::to_string(getpid());
    bool written = false;
    {
        std::ofstream out(temporary, std::ios::binary);
        const std::string file = packCache(data);
        written = bool(out.write(file.data(), std::streamsize(file.size())).flush());
    }
    std::error_code error;
    if (written) fs::rename(temporary, _file, error);
    if (!written || error) fs::remove(temporary, error);
}

} // namespace hipr
