#include "renderer/higs/splat_kernels.h"

#include "hipr_higs_kernels.h"
#include "shaders/shared/higs.h"

namespace hipr {
namespace {

struct Source {
    const uint32_t* spirv;
    size_t bytes;
};

/// Of one kernel: [lanes][half].
struct Sources {
    const char* name;
    Source forms[2][2];
};

#define HIPR_SPIRV(name)                                                                                     \
    { spirv::name##_spv, spirv::name##_spv_size }
#define HIPR_ONE_FORM(name)                                                                                  \
    {                                                                                                        \
        {HIPR_SPIRV(name), HIPR_SPIRV(name)}, {                                                              \
            HIPR_SPIRV(name), HIPR_SPIRV(name)                                                               \
        }                                                                                                    \
    }
#define HIPR_BY_RECORD(name)                                                                                 \
    {                                                                                                        \
        {HIPR_SPIRV(name), HIPR_SPIRV(name##_half)}, {                                                       \
            HIPR_SPIRV(name), HIPR_SPIRV(name##_half)                                                        \
        }                                                                                                    \
    }
#define HIPR_BY_LANES(name)                                                                                  \
    {                                                                                                        \
        {HIPR_SPIRV(name), HIPR_SPIRV(name)}, {                                                              \
            HIPR_SPIRV(name##_lanes), HIPR_SPIRV(name##_lanes)                                               \
        }                                                                                                    \
    }
#define HIPR_BY_BOTH(name)                                                                                   \
    {                                                                                                        \
        {HIPR_SPIRV(name), HIPR_SPIRV(name##_half)}, {                                                       \
            HIPR_SPIRV(name##_lanes), HIPR_SPIRV(name##_lanes_half)                                          \
        }                                                                                                    \
    }

const Sources& sourcesOf(SplatKernel kernel) {
    static const Sources table[size_t(SplatKernel::Number)] = {
        {"splat project", HIPR_BY_RECORD(splat_project)}, {"splat touch", HIPR_BY_RECORD(splat_touch)},
        {"splat count", HIPR_BY_BOTH(splat_count)},       {"splat offsets", HIPR_ONE_FORM(splat_offsets)},
        {"splat tiles", HIPR_BY_LANES(splat_tiles)},      {"splat fill", HIPR_BY_BOTH(splat_fill)},
        {"splat sort", HIPR_BY_LANES(splat_sort)},        {"splat merge", HIPR_BY_LANES(splat_merge)},
        {"splat mask", HIPR_BY_RECORD(splat_mask)},       {"splat raster", HIPR_BY_RECORD(splat_raster)},
    };
    return table[size_t(kernel)];
}

} // namespace

void SplatKernelSet::compile(std::initializer_list<SplatKernel> kernels) {
    for (const SplatKernel kernel : kernels) {
        std::optional<Kernel>& slot = _kernels[size_t(kernel)];
        if (slot) continue;
        const Sources& sources = sourcesOf(kernel);
        const Source& source = sources.forms[_lanes][_half];
        slot.emplace(_device, source.spirv, source.bytes, uint32_t(sizeof(gpu::SplatPush)), sources.name);
        slot->warm();
    }
}

} // namespace hipr
