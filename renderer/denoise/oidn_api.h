/// @file oidn_api.h
/// What is used of the C interface of Open Image Denoise 2, as its manual documents it, found at run time.
#pragma once

#include <cstddef>
#include <string>

namespace hipr {

/// Handles are pointers of the library.
struct OidnApi {
    using Device = void*;
    using Filter = void*;
    using Monitor = bool (*)(void* user, double share); ///< false ends the filter

    static constexpr int CpuDevice = 1; ///< OIDN_DEVICE_TYPE_CPU
    static constexpr int Float3 = 3;    ///< OIDN_FORMAT_FLOAT3
    static constexpr int Cancelled = 6; ///< OIDN_ERROR_CANCELLED

    Device (*newDevice)(int type) = nullptr;
    void (*setDeviceInt)(Device, const char* name, int value) = nullptr;
    void (*setDeviceBool)(Device, const char* name, bool value) = nullptr;
    void (*commitDevice)(Device) = nullptr;
    void (*releaseDevice)(Device) = nullptr;
    int (*getDeviceError)(Device, const char** message) = nullptr;
    Filter (*newFilter)(Device, const char* type) = nullptr;
    void (*setSharedFilterImage)(Filter, const char* name, void* pixels, int format, size_t width,
                                 size_t height, size_t byteOffset, size_t pixelStride,
                                 size_t rowStride) = nullptr;
    void (*setFilterBool)(Filter, const char* name, bool value) = nullptr;
    void (*setFilterProgressMonitorFunction)(Filter, Monitor, void* user) = nullptr;
    void (*commitFilter)(Filter) = nullptr;
    void (*executeFilter)(Filter) = nullptr;
    void (*releaseFilter)(Filter) = nullptr;
};

/// The functions of the library in `path`, which stays loaded for good. Null, with the loader's reason in
/// `error`.
const OidnApi* loadOidn(const std::string& path, std::string* error);

/// The library to load: $HIPR_OIDN_LIBRARY, where a folder stands for the library in it, else its name.
std::string oidnLibrary();

} // namespace hipr
