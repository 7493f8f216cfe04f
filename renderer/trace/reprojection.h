/// @file reprojection.h
/// Carries the picture on display to where another camera sees what it shows. See docs/hipr.md, "Camera
/// motion".
///
///     depth    the picture on display, wherever it is, goes to oldPicture; what is nearest in each new pixel
///     source   which old pixel shows it
///     paint    the new picture, cracks closed and gaps guessed; what is wrong with it
#pragma once

#include "renderer/hipr/schedule.h"
#include "renderer/vulkan/background_kernels.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/queue.h"
#include "shaders/shared/reproject.h"

namespace hipr {

/// What a picture is carried in, one entry a pixel.
struct CarriedPicture {
    const Buffer& film;       ///< gpu::FilmPixel
    const Buffer& oldPicture; ///< gpu::OldPixel
    const Buffer& seen;       ///< gpu::SeenPoint
    const Buffer& seenAfter;  ///< gpu::SeenPoint, written
    const Buffer& sources;    ///< gpu::CarriedSource, for the time of carry()
};

class Reprojection {
public:
    explicit Reprojection(Device& device);

    /// Whether all kernels are compiled; waits up to `patience` for it.
    bool ready(std::chrono::milliseconds patience) { return _kernels.ready(patience); }

    /// Carries the picture from one camera to another; the film then holds it as means of one sample. False,
    /// and film and seen are as they were, when less than a quarter of it stays in sight. The kernels must be
    /// ready. `rows`: what the new picture is worth, tileSize entries a tile.
    bool carry(const CarriedPicture& picture, const TileSchedule& schedule, const gpu::CameraRecord& before,
               const gpu::CameraRecord& after, std::vector<gpu::CarriedRow>& rows);

private:
    enum KernelId { Depth, Source, Paint };
    void describe(const CarriedPicture& picture, const TileSchedule& schedule,
                  const gpu::CameraRecord& before, const gpu::CameraRecord& after);
    void dispatch(VkCommandBuffer cmd, KernelId kernel, uint32_t invocations);

    Device& _device;
    BackgroundKernels _kernels;
    Buffer _record, _cameras, _counts, _tileKeepsOld, _rows;
    uint64_t _rowCount = 0, _tiles = 0;
};

} // namespace hipr
