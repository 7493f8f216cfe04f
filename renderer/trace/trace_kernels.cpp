#include "renderer/trace/trace_kernels.h"

#include "hipr_trace_kernels.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/trace.h"

namespace hipr {

std::vector<KernelSource> traceKernelSources() {
    constexpr uint32_t push = sizeof(gpu::TraceKernelPush);
    using namespace spirv;
    return {
        {raygen_spv, raygen_spv_size, push, "raygen"},
        {resolve_spv, resolve_spv_size, push, "resolve"},
        {shadow_spv, shadow_spv_size, push, "shadow"},
        {visibility_rays_spv, visibility_rays_spv_size, push, "visibility_rays"},
        {prepare_spv, prepare_spv_size, push, "prepare"},
        {scout_spv, scout_spv_size, push, "scout"},
    };
}

std::vector<KernelSource> shadingKernelSources(uint32_t features) {
    constexpr uint32_t push = sizeof(gpu::TraceKernelPush);
    using namespace spirv;
    std::vector<KernelSource> sources = {
        {shade_spv, shade_spv_size, push, "shade", false, features},
        {visibility_spv, visibility_spv_size, push, "visibility", false, features},
        {transmit_spv, transmit_spv_size, push, "transmit", false, features},
    };
    if (features & gpu::SCENE_HAS_MESH_LIGHTS)
        sources.push_back({emission_spv, emission_spv_size, push, "emission", false, features});
    return sources;
}

std::vector<KernelSource> filmKernelSources() {
    constexpr uint32_t push = sizeof(gpu::TraceKernelPush);
    using namespace spirv;
    return {
        {cryptomatte_spv, cryptomatte_spv_size, push, "cryptomatte"},
        {lpe_spv, lpe_spv_size, push, "lpe"},
    };
}

std::vector<KernelSource> volumeKernelSources() {
    constexpr uint32_t push = sizeof(gpu::TraceKernelPush);
    using namespace spirv;
    return {
        {volume_spv, volume_spv_size, push, "volume"},
        {volume_shadow_spv, volume_shadow_spv_size, push, "volume_shadow"},
    };
}

} // namespace hipr
