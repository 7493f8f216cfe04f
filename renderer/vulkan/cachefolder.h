/// @file cachefolder.h
/// Where compiled kernels are kept between runs.
#pragma once

#include <filesystem>

namespace hipr {

/// $XDG_CACHE_HOME/hipr or ~/.cache/hipr, or `name` in it; created when missing. Empty when there is no home
/// folder or it cannot be written: caching is then off.
std::filesystem::path cacheFolder(const char* name = "");

/// Points Mesa's own shader cache ($MESA_SHADER_CACHE_DIR) into cacheFolder(), unless the user set it. This
/// is what makes a second start quick on CPU devices, whose VkPipelineCache holds nothing. Has to run before
/// the first instance is created.
void setMesaCacheFolder();

/// Deletes the compiled kernels that are kept. Those in use go on; the next start compiles
/// them again. Returns whether nothing was left behind.
bool clearKernelCaches();

} // namespace hipr
