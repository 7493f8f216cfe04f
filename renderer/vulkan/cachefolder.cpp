#include "renderer/vulkan/cachefolder.h"

#include <cstdlib>
#include <mutex>

namespace hipr {

namespace fs = std::filesystem;

fs::path cacheFolder(const char* name) {
    fs::path folder;
    const char* xdg = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    if (xdg && *xdg)
        folder = fs::path(xdg) / "hipr";
    else if (home && *home)
        folder = fs::path(home) / ".cache" / "hipr";
    else
        return {};
    folder /= name;
    std::error_code error;
    fs::create_directories(folder, error);
    return error ? fs::path() : folder;
}

bool clearKernelCaches() {
    bool cleared = true;
    for (const char* name : {"pipelines", "mesa"}) {
        const fs::path folder = cacheFolder(name);
        std::error_code error;
        if (!folder.empty()) fs::remove_all(folder, error);
        cleared = cleared && !error;
    }
    return cleared;
}

void setMesaCacheFolder() {
    static std::once_flag once;
    std::call_once(once, [] {
        if (std::getenv("MESA_SHADER_CACHE_DIR")) return;
        const fs::path folder = cacheFolder("mesa");
        if (!folder.empty()) setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), 0);
    });
}

} // namespace hipr
