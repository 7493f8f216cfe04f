#include "renderer/trace/reprojection.h"

#include <algorithm>

#include "hipr_trace_kernels.h"
#include "renderer/hipr/staleness.h"

namespace hipr {
namespace {

/// A picture of which less stays in sight is of another place: what little there is would mislead.
constexpr double LeastShare = 0.25;

static_assert(sizeof(gpu::SeenPoint) == 16 && sizeof(gpu::OldPixel) == 32 && sizeof(gpu::FilmPixel) == 56,
              "shaders/hipr/reprojection.glsl reads them by pairs of words");

uint32_t groups(uint32_t items, uint32_t perGroup) {
    return (items + perGroup - 1) / perGroup;
}

std::vector<KernelSource> sources() {
    constexpr uint32_t push = sizeof(gpu::ReprojectionPush);
    using namespace spirv;
    return {
        {reproject_depth_spv, reproject_depth_spv_size, push, "reproject depth"},
        {reproject_source_spv, reproject_source_spv_size, push, "reproject source"},
        {reproject_torn_spv, reproject_torn_spv_size, push, "reproject torn"},
        {reproject_mend_spv, reproject_mend_spv_size, push, "reproject mend"},
        {reproject_paint_spv, reproject_paint_spv_size, push, "reproject paint"},
    };
}

} // namespace

Reprojection::Reprojection(Device& device)
    : _device(device), _kernels(device, sources()),
      _cameras(device.createBuffer(2 * sizeof(gpu::CameraRecord), MemoryUse::Device, "Reprojection")),
      _counts(device.createBuffer(sizeof(gpu::CarriedCounts), MemoryUse::Device, "Reprojection")) {}

void Reprojection::describe(const CarriedPicture& picture, const TileSchedule& schedule,
                            const gpu::CameraRecord& before, const gpu::CameraRecord& after) {
    const TileGrid& grid = schedule.grid();
    const uint64_t strips = stripsOf(grid);
    if (_tiles != grid.count() || _stripCount != strips) {
        _tiles = grid.count();
        _stripCount = strips;
        _tileKeepsOld = _device.createBuffer(_tiles * sizeof(uint32_t), MemoryUse::Device, "Reprojection");
        _strips = _device.createBuffer(strips * sizeof(gpu::CarriedStrip), MemoryUse::Device, "Reprojection");
    }
    std::vector<uint32_t> keepsOld;
    for (const TileState& tile : schedule.tiles())
        keepsOld.push_back(tile.keepsOld);
    _device.upload(_tileKeepsOld, keepsOld.data(), keepsOld.size() * sizeof(uint32_t));
    const gpu::CameraRecord cameras[] = {before, after};
    _device.upload(_cameras, cameras, sizeof(cameras));

    _push.before = _cameras.address();
    _push.after = _cameras.address() + sizeof(gpu::CameraRecord);
    _push.film = picture.film.address();
    _push.oldPicture = picture.oldPicture.address();
    _push.carried = picture.carried.address();
    _push.tileKeepsOld = _tileKeepsOld.address();
    _push.seen = picture.seen.address();
    _push.seenAfter = picture.seenAfter.address();
    _push.lists = picture.lists.address();
    _push.depths = picture.depths;
    _push.strips = _strips.address();
    _push.counts = _counts.address();
    _push.width = grid.width;
    _push.height = grid.height;
    _push.tileShift = 0;
    while (1u << _push.tileShift < grid.tileSize)
        ++_push.tileShift;
    _push.tileColumns = grid.columns;
}

/// One invocation for so many pixels one below the other.
void Reprojection::dispatch(VkCommandBuffer cmd, KernelId kernel, uint32_t rows) {
    const uint32_t columns = _push.tileColumns << _push.tileShift;
    _kernels.get(kernel).dispatch(cmd, &_push, groups(columns, gpu::TRACE_GROUP_SIZE),
                                  groups(_push.height, rows));
}

void Reprojection::mend(VkCommandBuffer cmd, uint32_t torn) {
    const uint32_t all = groups(torn, gpu::TRACE_GROUP_SIZE);
    _kernels.get(Mend).dispatch(cmd, &_push, std::min(all, gpu::MEND_GROUPS), groups(all, gpu::MEND_GROUPS));
}

bool Reprojection::carry(const CarriedPicture& picture, const TileSchedule& schedule,
                         const gpu::CameraRecord& before, const gpu::CameraRecord& after,
                         std::vector<gpu::CarriedStrip>& strips) {
    describe(picture, schedule, before, after);
    _device.run([&](VkCommandBuffer cmd) {
        vkCmdFillBuffer(cmd, picture.lists.handle(), 0, VK_WHOLE_SIZE, gpu::NO_INDEX);
        vkCmdFillBuffer(cmd, _counts.handle(), 0, VK_WHOLE_SIZE, 0);
        for (KernelId kernel : {Depth, Source, Torn}) {
            computeBarrier(cmd);
            dispatch(cmd, kernel, kernel == Torn ? gpu::CARRIED_ROWS : 1);
        }
    });
    gpu::CarriedCounts counts;
    _device.download(_counts, &counts, sizeof(counts));
    if (counts.inside == 0 || double(counts.inside) < LeastShare * double(counts.known)) return false;
    _device.run([&](VkCommandBuffer cmd) {
        if (counts.torn > 0) mend(cmd, counts.torn);
        computeBarrier(cmd);
        dispatch(cmd, Paint, 1);
    });
    strips.resize(_stripCount);
    _device.download(_strips, strips.data(), strips.size() * sizeof(gpu::CarriedStrip));
    return true;
}

} // namespace hipr
