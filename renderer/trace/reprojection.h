/// @file reprojection.h
/// Carries the picture on display to where another camera sees what it shows. See docs/hipr.md, "Camera
/// motion".
///
///     depth    what is nearest in each new pixel
///     source   which old pixel shows it
///     torn     which new pixels may be cracks or gaps
///     mend     closes cracks, guesses gaps
///     paint    the new picture; what is wrong with it
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
    const Buffer& carried;    ///< gpu::OldPixel, written: the picture where it is carried to
    const Buffer& seen;       ///< gpu::SeenPoint
    const Buffer& seenAfter;  ///< gpu::SeenPoint, written
    const Buffer& lists;      ///< uint32_t[gpu::CARRIED_LISTS], for the time of carry()
    VkDeviceAddress depths;   ///< float, written: camera depths of what is carried; 0: they are not wanted
};

class Reprojection {
public:
    explicit Reprojection(Device& device);

    /// Whether all kernels are compiled; waits up to `patience` for it.
    bool ready(std::chrono::milliseconds patience) { return _kernels.ready(patience); }

    /// Carries the picture from one camera to another. False, and nothing is carried, when less than a
    /// quarter of it stays in sight. The kernels must be ready. `strips`: what the new picture is worth.
    bool carry(const CarriedPicture& picture, const TileSchedule& schedule, const gpu::CameraRecord& before,
               const gpu::CameraRecord& after, std::vector<gpu::CarriedStrip>& strips);

private:
    enum KernelId { Depth, Source, Torn, Mend, Paint };
    void describe(const CarriedPicture& picture, const TileSchedule& schedule,
                  const gpu::CameraRecord& before, const gpu::CameraRecord& after);
    void dispatch(VkCommandBuffer cmd, KernelId kernel, uint32_t rows);
    void mend(VkCommandBuffer cmd, uint32_t torn);

    Device& _device;
    BackgroundKernels _kernels;
    Buffer _cameras, _counts, _tileKeepsOld, _strips;
    gpu::ReprojectionPush _push{};
    uint64_t _stripCount = 0, _tiles = 0;
};

} // namespace hipr
