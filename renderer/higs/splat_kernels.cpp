#include "renderer/higs/splat_kernels.h"

#include "hipr_higs_kernels.h"
#include "renderer/vulkan/device.h"
#include "renderer/vulkan/structs.h"
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
        {"splat project", HIPR_BY_RECORD(splat_project)},
        {"splat touch", HIPR_BY_RECORD(splat_touch)},
        {"splat count", HIPR_BY_BOTH(splat_count)},
        {"splat offsets", HIPR_ONE_FORM(splat_offsets)},
        {"splat tiles", HIPR_BY_LANES(splat_tiles)},
        {"splat fill", HIPR_BY_BOTH(splat_fill)},
        {"splat sort", HIPR_BY_LANES(splat_sort)},
        {"splat merge", HIPR_BY_LANES(splat_merge)},
        {"splat mask", HIPR_BY_RECORD(splat_mask)},
        {"splat raster", HIPR_BY_BOTH(splat_raster)},
        {"splat raster limited", HIPR_BY_BOTH(splat_raster_limited)},
        {"splat partial", HIPR_BY_BOTH(splat_partial)},
        {"splat partial limited", HIPR_BY_BOTH(splat_partial_limited)},
        {"splat compose", HIPR_BY_BOTH(splat_compose)},
        {"splat compose limited", HIPR_BY_BOTH(splat_compose_limited)},
        {"splat tally", HIPR_BY_RECORD(splat_tally)},
        {"splat partial tally", HIPR_BY_RECORD(splat_tally_partial)},
        {"splat flat count", HIPR_BY_RECORD(splat_flat_count)},
        {"splat flat pairs", HIPR_ONE_FORM(splat_flat_pairs)},
        {"splat flat fill", HIPR_BY_RECORD(splat_flat_fill)},
        {"splat flat digits", HIPR_ONE_FORM(splat_flat_digits)},
        {"splat flat scan", HIPR_ONE_FORM(splat_flat_scan)},
        {"splat flat move", HIPR_ONE_FORM(splat_flat_move)},
        {"splat flat tiles", HIPR_ONE_FORM(splat_flat_tiles)},
        {"splat flat raster", HIPR_BY_BOTH(splat_raster_flat)},
        {"splat flat raster limited", HIPR_BY_BOTH(splat_raster_flat_limited)},
        {"splat flat tally", HIPR_BY_RECORD(splat_tally_flat)},
    };
    return table[size_t(kernel)];
}

} // namespace

bool canRunLanes(const Device& device) {
    auto subgroup =
        vkStruct<VkPhysicalDeviceSubgroupProperties>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES);
    auto properties = vkStruct<VkPhysicalDeviceProperties2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2);
    properties.pNext = &subgroup;
    vkGetPhysicalDeviceProperties2(device.physical(), &properties);
    return subgroup.subgroupSize >= 8 && (subgroup.supportedOperations & VK_SUBGROUP_FEATURE_SHUFFLE_BIT);
}

void SplatKernelSet::compile(const std::vector<SplatKernel>& kernels) {
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
