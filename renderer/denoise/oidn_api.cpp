#include "renderer/denoise/oidn_api.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>

#include <dlfcn.h>

namespace hipr {
namespace {

constexpr char LibraryFile[] = "libOpenImageDenoise.so.2";

/// Finds one function after the other.
class Symbols {
public:
    explicit Symbols(void* library) : _library(library) {}
    template <class Function> void find(Function& function, const char* name) {
        function = reinterpret_cast<Function>(dlsym(_library, name));
        if (!function && _missing.empty()) _missing = name;
    }
    const std::string& missing() const { return _missing; }

private:
    void* _library;
    std::string _missing;
};

/// The name of a function that the library lacks, or nothing.
std::string findAll(void* library, OidnApi& api) {
    Symbols symbols(library);
    symbols.find(api.newDevice, "oidnNewDevice");
    symbols.find(api.setDeviceInt, "oidnSetDeviceInt");
    symbols.find(api.setDeviceBool, "oidnSetDeviceBool");
    symbols.find(api.commitDevice, "oidnCommitDevice");
    symbols.find(api.releaseDevice, "oidnReleaseDevice");
    symbols.find(api.getDeviceError, "oidnGetDeviceError");
    symbols.find(api.newFilter, "oidnNewFilter");
    symbols.find(api.setSharedFilterImage, "oidnSetSharedFilterImage");
    symbols.find(api.setFilterBool, "oidnSetFilterBool");
    symbols.find(api.setFilterProgressMonitorFunction, "oidnSetFilterProgressMonitorFunction");
    symbols.find(api.commitFilter, "oidnCommitFilter");
    symbols.find(api.executeFilter, "oidnExecuteFilter");
    symbols.find(api.releaseFilter, "oidnReleaseFilter");
    return symbols.missing();
}

} // namespace

std::string oidnLibrary() {
    const char* given = std::getenv("HIPR_OIDN_LIBRARY");
    if (!given || !*given) return LibraryFile;
    std::error_code none;
    const std::filesystem::path path(given);
    return std::filesystem::is_directory(path, none) ? (path / LibraryFile).string() : path.string();
}

const OidnApi* loadOidn(const std::string& path, std::string* error) {
    static std::mutex mutex;
    static std::map<std::string, OidnApi> loaded; // addresses stay
    std::lock_guard<std::mutex> lock(mutex);
    const auto known = loaded.find(path);
    if (known != loaded.end()) return &known->second;
    // Nobody else sees its symbols. Never closed: its threads may outlive the last device.
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char* reason = dlerror();
        *error = reason ? reason : "'" + path + "' cannot be loaded";
        return nullptr;
    }
    OidnApi api;
    const std::string missing = findAll(library, api);
    if (!missing.empty()) {
        *error = "'" + path + "' has no function " + missing;
        return nullptr;
    }
    return &loaded.emplace(path, api).first->second;
}

} // namespace hipr
