// Compiled into every program of a build with HIPR_SANITIZE: how the sanitizers run.
#include <cstring>
#include <dlfcn.h>

#define HIPR_SANITIZER extern "C" __attribute__((visibility("default"), used)) const char*

HIPR_SANITIZER __asan_default_options() {
    // An allocation that is too large is to fail as it would anywhere. hiprrecord and the plugin it loads
    // both hold the renderer's static libraries, which is no violation of the one-definition rule as each
    // keeps to its own.
    return "allocator_may_return_null=1:detect_odr_violation=0:detect_stack_use_after_return=1";
}

HIPR_SANITIZER __ubsan_default_options() {
    return "print_stacktrace=1:halt_on_error=1";
}

HIPR_SANITIZER __lsan_default_suppressions() {
    // Singletons that OpenUSD 20.08 and its TBB make once and never return. Functions, not libraries: the
    // delegate's own prims are made below frames of those libraries.
    return "leak:tbb::internal::arena::arena\n"
           "leak:Tf_RegistryManagerImpl\n"
           "leak:WorkArenaDispatcher::_GetArena\n"
           // What its caches and paths hold on to.
           "leak:UsdShadeMaterialBindingAPI::ComputeBoundMaterial\n"
           "leak:Sdf_PrimVariantSelectionNode\n";
}

#ifdef __SANITIZE_ADDRESS__

/// TBB without its own allocator: what only memory of that points to, as Sdf's data do, would count as
/// leaked.
extern "C" __attribute__((visibility("default"), used)) void* dlopen(const char* file, int mode) {
    static const auto next = reinterpret_cast<void* (*)(const char*, int)>(dlsym(RTLD_NEXT, "dlopen"));
    return file && std::strstr(file, "tbbmalloc") ? nullptr : next(file, mode);
}
#endif
