#include "renderer/higs/splat_stages.h"

#include <algorithm>
#include <cstddef>

namespace hipr {
namespace {

constexpr uint32_t GroupsPerRow = 32768; ///< of long rows of workgroups; a dispatch has at most 65535 in x

} // namespace

SplatStages::SplatStages(Device& device, bool lanes, bool half)
    : _device(device), _kernels(device, lanes, half), _buffers(device, lanes, half) {}

void SplatStages::setUp(SplatMode mode, gpu::SplatFrame frame,
                        const std::vector<gpu::SplatPlacement>& placements,
                        const std::vector<gpu::SplatBlock>& blocks, const gpu::CameraRecord& camera) {
    _mode = mode;
    _kernels.compile({SplatKernel::Project, SplatKernel::Touch, SplatKernel::Count, SplatKernel::Tiles,
                      SplatKernel::Fill, SplatKernel::Sort, SplatKernel::Merge, SplatKernel::Mask,
                      SplatKernel::Raster});
    if (_kernels.lanes()) _kernels.compile({SplatKernel::Offsets});
    _buffers.blocks.reserve(_device, blocks.size() * sizeof(gpu::SplatBlock));
    _buffers.prepare(frame, SplatSorting(frame.sorting) == SplatSorting::RayHitDistance);
    _device.upload(_buffers.blocks.buffer(), blocks.data(), blocks.size() * sizeof(blocks[0]));
    _device.upload(_buffers.placements.buffer(), placements.data(),
                   placements.size() * sizeof(placements[0]));
    _device.upload(_buffers.camera.buffer(), &camera, sizeof(camera));
    _device.upload(_buffers.frame.buffer(), &frame, sizeof(frame));
    _frame = frame;
}

void SplatStages::dispatch(VkCommandBuffer cmd, SplatKernel kernel, uint32_t groups, uint32_t first,
                           uint32_t count) const {
    const gpu::SplatPush push{_buffers.frame.address(), first, count};
    const uint32_t columns = std::min(groups, GroupsPerRow);
    if (groups) _kernels[kernel].dispatch(cmd, &push, columns, (groups + columns - 1) / columns);
}

void SplatStages::dispatchIndirect(VkCommandBuffer cmd, SplatKernel kernel, size_t offset,
                                   uint32_t first) const {
    const gpu::SplatPush push{_buffers.frame.address(), first, 0};
    _kernels[kernel].dispatchIndirect(cmd, &push, _buffers.state.buffer(), offset);
}

void SplatStages::clear(VkCommandBuffer cmd, bool drawAll) const {
    clearState(cmd);
    vkCmdFillBuffer(cmd, _buffers.tileMask.buffer().handle(), 0, VK_WHOLE_SIZE, drawAll ? 1 : 0);
}

void SplatStages::clearState(VkCommandBuffer cmd) const {
    vkCmdFillBuffer(cmd, _buffers.state.buffer().handle(), 0, sizeof(gpu::SplatState), 0);
}

void SplatStages::project(VkCommandBuffer cmd, uint32_t first, uint32_t end) const {
    dispatch(cmd, SplatKernel::Project, end - first, first, end);
}

void SplatStages::touch(VkCommandBuffer cmd, uint32_t first, uint32_t end) const {
    dispatch(cmd, SplatKernel::Touch, end - first, first, end);
}

uint32_t SplatStages::binGroups() const {
    return _kernels.lanes() ? gpu::SPLAT_CHUNKS / 8 : (_frame.splatCount + 255) / 256;
}

void SplatStages::count(VkCommandBuffer cmd) const {
    vkCmdFillBuffer(cmd, _buffers.histogram.buffer().handle(), 0, _buffers.histogramBytes(_frame), 0);
    computeBarrier(cmd);
    dispatch(cmd, SplatKernel::Count, binGroups());
}

void SplatStages::scan(VkCommandBuffer cmd) const {
    if (_kernels.lanes()) {
        dispatch(cmd, SplatKernel::Offsets, (_frame.tileColumns * _frame.tileRows + 7) / 8);
        computeBarrier(cmd);
    }
    dispatch(cmd, SplatKernel::Tiles, 1);
}

void SplatStages::fill(VkCommandBuffer cmd) const {
    dispatch(cmd, SplatKernel::Fill, binGroups());
}

void SplatStages::sort(VkCommandBuffer cmd) const {
    dispatchIndirect(cmd, SplatKernel::Sort, offsetof(gpu::SplatState, sortGroups));
    for (uint32_t i = 0; i < gpu::SPLAT_MERGES; ++i) {
        computeBarrier(cmd);
        dispatchIndirect(cmd, SplatKernel::Merge,
                         offsetof(gpu::SplatState, mergeGroups) + i * sizeof(glm::uvec3), i);
    }
}

void SplatStages::masks(VkCommandBuffer cmd) const {
    dispatchIndirect(cmd, SplatKernel::Mask, offsetof(gpu::SplatState, maskGroups));
}

void SplatStages::raster(VkCommandBuffer cmd, uint32_t first, uint32_t rows) const {
    const gpu::SplatPush push{_buffers.frame.address(), first, 0};
    _kernels[SplatKernel::Raster].dispatch(cmd, &push, (_frame.width + 63) / 64, rows);
}

gpu::SplatState SplatStages::state() const {
    gpu::SplatState state;
    _device.download(_buffers.state.buffer(), &state, sizeof(state));
    return state;
}

void SplatStages::makeRoom(const gpu::SplatState& state) {
    if (state.largestList > uint64_t(gpu::SPLAT_BATCH) << gpu::SPLAT_MERGES)
        throw OutOfMemory("more than " + std::to_string(gpu::SPLAT_BATCH << gpu::SPLAT_MERGES) +
                          " splats meet one tile");
    _buffers.reserveLists(uint64_t(state.pairsEnd) * 5 / 4, uint64_t(state.batches) * 5 / 4);
    _buffers.prepare(_frame, _frame.rays != 0);
    _device.upload(_buffers.frame.buffer(), &_frame, sizeof(_frame));
}

} // namespace hipr
