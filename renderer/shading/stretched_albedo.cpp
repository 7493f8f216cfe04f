#include "renderer/shading/stretched_albedo.h"

#include <glm/glm.hpp>

#include "hipr_shading_kernels.h"
#include "renderer/vulkan/kernel.h"
#include "shaders/shared/material.h"

namespace hipr {

static_assert(gpu::STRETCHED_PLANES == 2 * gpu::STRETCHED_STEPS + 1);
static_assert(gpu::STRETCHED_ROW == gpu::STRETCHED_AZIMUTHS * gpu::STRETCHED_COSINES + 1);
static_assert(gpu::STRETCHED_ROWS ==
              gpu::STRETCHED_PLANES * gpu::STRETCHED_ANISOTROPIES * gpu::STRETCHED_ROUGHNESSES);

Buffer stretchedAlbedoTable(Device& device) {
    const uint64_t bytes = uint64_t(gpu::STRETCHED_ROWS) * gpu::STRETCHED_ROW * sizeof(glm::vec2);
    Buffer table = device.createBuffer(bytes, MemoryUse::Device, "materials");
    const VkDeviceAddress push = table.address();
    const Kernel kernel(device, spirv::stretched_spv, spirv::stretched_spv_size, sizeof push,
                        "stretched albedos");
    device.run([&](VkCommandBuffer cmd) { kernel.dispatch(cmd, &push, gpu::STRETCHED_ROWS); });
    return table;
}

} // namespace hipr
