#include "renderer/trace/reprojection.h"

#include <algorithm>

#include "hipr_trace_kernels.h"

namespace hipr {
namespace {

/// A picture of which less stays in sight is of another place: what little there is would mislead.
constexpr double LeastShare = 0.25;
/// Every device takes 65,535 workgroups.
constexpr uint32_t PerDispatch = 65535 * gpu::TRACE_GROUP_SIZE;

std::vector<KernelSource> sources() {
    constexpr uint32_t push = sizeof(gpu::ReprojectionPush);
    using namespace spirv;
    return {
        {reproject_depth_spv, reproject_depth_spv_size, push, "reproject depth"},
        {reproject_source_spv, reproject_source_spv_size, push, "reproject source"},
        {reproject_paint_spv, reproject_paint_spv_size, push, "reproject paint"},
    };
}

} // namespace

Reprojection::Reprojection(Device& device)
    : _device(device), _kernels(device, sources()),
      _record(device.createBuffer(sizeof(gpu::ReprojectionRecord), MemoryUse::Device, "Reprojection")),
      _cameras(device.createBuffer(2 * sizeof(gpu::CameraRecord), MemoryUse::Device, "Reprojection")),
      _counts(device.createBuffer(sizeof(gpu::CarriedCounts), MemoryUse::Device, "Reprojection")) {}

void Reprojection::describe(const CarriedPicture& picture, const TileSchedule& schedule,
                            const gpu::CameraRecord& before, const gpu::CameraRecord& after) {
    const TileGrid& grid = schedule.grid();
    if (_tiles != grid.count() || _rowCount != uint64_t(grid.count()) * grid.tileSize) {
        _tiles = grid.count();
        _rowCount = _tiles * grid.tileSize;
        _tileKeepsOld = _device.createBuffer(_tiles * sizeof(uint32_t), MemoryUse::Device, "Reprojection");
        _rows = _device.createBuffer(_rowCount * sizeof(gpu::CarriedRow), MemoryUse::Device, "Reprojection");
    }
    std::vector<uint32_t> keepsOld;
    for (const TileState& tile : schedule.tiles())
        keepsOld.push_back(tile.keepsOld);
    _device.upload(_tileKeepsOld, keepsOld.data(), keepsOld.size() * sizeof(uint32_t));
    const gpu::CameraRecord cameras[] = {before, after};
    _device.upload(_cameras, cameras, sizeof(cameras));

    gpu::ReprojectionRecord record{};
    record.before = _cameras.address();
    record.after = _cameras.address() + sizeof(gpu::CameraRecord);
    record.film = picture.film.address();
    record.oldPicture = picture.oldPicture.address();
    record.tileKeepsOld = _tileKeepsOld.address();
    record.seen = picture.seen.address();
    record.seenAfter = picture.seenAfter.address();
    record.sources = picture.sources.address();
    record.rows = _rows.address();
    record.counts = _counts.address();
    record.width = grid.width;
    record.height = grid.height;
    record.tileSize = grid.tileSize;
    record.tileColumns = grid.columns;
    _device.upload(_record, &record, sizeof(record));
}

void Reprojection::dispatch(VkCommandBuffer cmd, KernelId kernel, uint32_t invocations) {
    gpu::ReprojectionPush push{_record.address(), 0, 0};
    for (; push.first < invocations; push.first = push.end) {
        push.end = push.first + std::min(invocations - push.first, PerDispatch);
        const uint32_t groups = (push.end - push.first + gpu::TRACE_GROUP_SIZE - 1) / gpu::TRACE_GROUP_SIZE;
        _kernels.get(kernel).dispatch(cmd, &push, groups);
    }
}

bool Reprojection::carry(const CarriedPicture& picture, const TileSchedule& schedule,
                         const gpu::CameraRecord& before, const gpu::CameraRecord& after,
                         std::vector<gpu::CarriedRow>& rows) {
    describe(picture, schedule, before, after);
    const uint32_t pixels = schedule.grid().width * schedule.grid().height;
    _device.run([&](VkCommandBuffer cmd) {
        vkCmdFillBuffer(cmd, picture.sources.handle(), 0, VK_WHOLE_SIZE, gpu::NO_INDEX);
        vkCmdFillBuffer(cmd, _counts.handle(), 0, VK_WHOLE_SIZE, 0);
        computeBarrier(cmd);
        dispatch(cmd, Depth, pixels);
        computeBarrier(cmd);
        dispatch(cmd, Source, pixels);
    });
    gpu::CarriedCounts counts;
    _device.download(_counts, &counts, sizeof(counts));
    if (counts.inside == 0 || double(counts.inside) < LeastShare * double(counts.known)) return false;
    _device.run([&](VkCommandBuffer cmd) { dispatch(cmd, Paint, uint32_t(_rowCount)); });
    rows.resize(_rowCount);
    _device.download(_rows, rows.data(), rows.size() * sizeof(gpu::CarriedRow));
    return true;
}

} // namespace hipr
