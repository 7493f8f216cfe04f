#include "renderer/higs/splat_stages.h"

#include <algorithm>
#include <cstddef>

namespace hipr {
namespace {

constexpr uint32_t GroupsPerRow = 32768; ///< of long rows of workgroups; a dispatch has at most 65535 in x

/// What raster() runs.
SplatKernel rasterKernel(SplatMode mode, bool limited) {
    using K = SplatKernel;
    if (isFlat(mode)) return limited ? K::FlatRasterLimited : K::FlatRaster;
    if (mode == SplatMode::Higs8) return limited ? K::ComposeLimited : K::Compose;
    return limited ? K::RasterLimited : K::Raster;
}

SplatKernel partialKernel(bool limited) {
    return limited ? SplatKernel::PartialLimited : SplatKernel::Partial;
}

std::vector<SplatKernel> kernelsOf(SplatMode mode, bool lanes, bool limited, bool profiling) {
    using K = SplatKernel;
    std::vector<K> all = {K::Project};
    const auto add = [&](std::initializer_list<K> more) { all.insert(all.end(), more); };
    if (isFlat(mode))
        add({K::FlatCount, K::FlatPairs, K::FlatFill, K::FlatDigits, K::FlatScan, K::FlatMove, K::FlatTiles});
    else
        add({K::Touch, K::Count, K::Tiles, K::Fill, K::Sort, K::Merge, K::Mask});
    if (!isFlat(mode) && lanes) add({K::Offsets});
    if (mode == SplatMode::Higs8) add({partialKernel(limited)});
    add({rasterKernel(mode, limited)});
    if (profiling) add({isFlat(mode) ? K::FlatTally : mode == SplatMode::Higs8 ? K::TallyPartial : K::Tally});
    return all;
}

/// Bits of the largest tile number.
uint32_t tileBits(const gpu::SplatFrame& frame) {
    uint32_t bits = 1;
    while ((uint64_t(frame.tileColumns) * frame.tileRows - 1) >> bits)
        ++bits;
    return bits;
}

} // namespace

SplatStages::SplatStages(Device& device, bool lanes, bool half)
    : _device(device), _kernels(device, lanes, half), _buffers(device, lanes, half) {}

void SplatStages::compile(SplatMode mode, bool limited, bool profiling) {
    // Kernels that tally are in lanes.
    _kernels.compile(kernelsOf(mode, _kernels.lanes(), limited, profiling && canRunLanes(_device)));
}

void SplatStages::setUp(SplatMode mode, gpu::SplatFrame frame,
                        const std::vector<gpu::SplatPlacement>& placements,
                        const std::vector<gpu::SplatBlock>& blocks, const gpu::CameraRecord& camera) {
    _mode = mode;
    compile(mode, frame.depthLimit != 0, frame.flags & gpu::FRAME_PROFILING);
    _buffers.blocks.reserve(_device, blocks.size() * sizeof(gpu::SplatBlock));
    _buffers.prepare(mode, frame);
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

void SplatStages::forgetEmpty(VkCommandBuffer cmd) const {
    vkCmdFillBuffer(cmd, _buffers.emptied.buffer().handle(), 0, VK_WHOLE_SIZE, 0);
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
    if (isFlat(_mode)) return dispatch(cmd, SplatKernel::FlatCount, gpu::SPLAT_CHUNKS / 8);
    vkCmdFillBuffer(cmd, _buffers.histogram.buffer().handle(), 0, _buffers.histogramBytes(_frame), 0);
    computeBarrier(cmd);
    dispatch(cmd, SplatKernel::Count, binGroups());
}

void SplatStages::scan(VkCommandBuffer cmd) const {
    if (isFlat(_mode)) return dispatch(cmd, SplatKernel::FlatPairs, 1);
    if (_kernels.lanes()) {
        dispatch(cmd, SplatKernel::Offsets, (_frame.tileColumns * _frame.tileRows + 7) / 8);
        computeBarrier(cmd);
    }
    dispatch(cmd, SplatKernel::Tiles, 1);
}

void SplatStages::fill(VkCommandBuffer cmd) const {
    if (isFlat(_mode))
        dispatch(cmd, SplatKernel::FlatFill, gpu::SPLAT_CHUNKS / 8);
    else
        dispatch(cmd, SplatKernel::Fill, binGroups());
}

void SplatStages::sortFlat(VkCommandBuffer cmd) const {
    uint32_t side = 0;
    for (uint32_t shift = 0; shift < 32 + tileBits(_frame); shift += 8, side = 1 - side) {
        if (shift) computeBarrier(cmd);
        dispatch(cmd, SplatKernel::FlatDigits, gpu::SPLAT_CHUNKS / 8, shift, side);
        computeBarrier(cmd);
        dispatch(cmd, SplatKernel::FlatScan, 1);
        computeBarrier(cmd);
        dispatch(cmd, SplatKernel::FlatMove, gpu::SPLAT_CHUNKS / 8, shift, side);
    }
    computeBarrier(cmd);
    dispatch(cmd, SplatKernel::FlatTiles, (_frame.tileColumns * _frame.tileRows + 63) / 64, 0, side);
}

void SplatStages::sort(VkCommandBuffer cmd) const {
    if (isFlat(_mode)) return sortFlat(cmd);
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

void SplatStages::partials(VkCommandBuffer cmd) const {
    dispatchIndirect(cmd, partialKernel(_frame.depthLimit != 0), offsetof(gpu::SplatState, partialGroups));
}

void SplatStages::dispatchPixels(VkCommandBuffer cmd, SplatKernel kernel, uint32_t first, uint32_t rows,
                                 bool lanes) const {
    const gpu::SplatPush push{_buffers.frame.address(), first, 0};
    const uint32_t tiles = lanes ? gpu::SPLAT_LANES_TILES : 1; // that a workgroup draws
    if (isFlat(_mode)) {
        const uint32_t pixels = tiles * gpu::SPLAT_TILE;
        return _kernels[kernel].dispatch(cmd, &push, (_frame.width + pixels - 1) / pixels, rows);
    }
    constexpr uint32_t Columns = gpu::SPLAT_MACRO_WIDTH / gpu::SPLAT_TILE,
                       Rows = gpu::SPLAT_MACRO_HEIGHT / gpu::SPLAT_TILE;
    _kernels[kernel].dispatch(cmd, &push, _frame.tileColumns * (Columns * Rows / tiles),
                              (rows + Rows - 1) / Rows);
}

void SplatStages::raster(VkCommandBuffer cmd, uint32_t first, uint32_t rows) const {
    dispatchPixels(cmd, rasterKernel(_mode, _frame.depthLimit != 0), first, rows, _kernels.lanes());
}

void SplatStages::tally(VkCommandBuffer cmd, uint32_t batches) const {
    vkCmdFillBuffer(cmd, _buffers.blends.buffer().handle(), 0, VK_WHOLE_SIZE, 0);
    computeBarrier(cmd);
    if (isFlat(_mode)) return dispatchPixels(cmd, SplatKernel::FlatTally, 0, pixelRows(), true);
    if (_mode == SplatMode::Higs8Carry) return dispatchPixels(cmd, SplatKernel::Tally, 0, pixelRows(), true);
    // Kernels that tally are in lanes: a workgroup draws a batch.
    const gpu::SplatPush push{_buffers.frame.address(), 0, 0};
    if (batches) _kernels[SplatKernel::TallyPartial].dispatch(cmd, &push, 1, std::min(batches, 65535u));
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
    _buffers.prepare(_mode, _frame);
    _device.upload(_buffers.frame.buffer(), &_frame, sizeof(_frame));
}

} // namespace hipr
