/// @file splat_pass.h
/// Draws clouds of splats, all instances sorted as one. The method: docs/higs.md.
///
///     SplatPass pass(device);
///     pass.setView(view);
///     pass.setInstances({{store, objectToWorld, primId, instanceId}});
///     pass.render();                                     // pass.pixels(): gpu::SplatPixel of every pixel
///
/// render() does what the changes since the last one ask for: after a moved or hidden instance only
/// macro-tiles (64 x 32 pixels) are drawn again in which it was or is. Instances whose bounds are out of the
/// picture cost nothing.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "renderer/higs/splat_store.h"

namespace hipr {

/// How splats are assigned to parts of the picture, and in which order those are blended. All draw the same
/// picture up to rounding; the flat ones are there to compare with. docs/higs.md describes them.
enum class SplatMode : uint32_t {
    Automatic,  ///< the fastest on this kind of device, by measurement
    Flat16Aabb, ///< 16 x 16 tiles, squares of 3 standard deviations (3DGS); cuts splats off at that square
    Flat16Exact,
    Flat8Exact,
    Higs8,      ///< batches of 1024 splats drawn independently, then blended
    Higs8Carry, ///< a tile carries its transmittance from batch to batch and stops when it is opaque
};
const char* splatModeName(SplatMode mode); ///< "higs8-carry", ...

/// Which form the kernels have. Both draw the same picture up to rounding.
enum class SplatKernels : uint32_t {
    Automatic,  ///< Lanes on CPU devices, else Workgroups
    Lanes,      ///< no barriers; Workgroups where subgroups are smaller than eight
    Workgroups, ///< cooperating workgroups
};

struct SplatPassOptions {
    SplatKernels kernels = SplatKernels::Automatic;
    SplatMode mode = SplatMode::Automatic; ///< to begin with; its kernels are compiled at once
    bool halfRecords =
        false; ///< conics and colours of projected splats in half precision: 40 instead of 48 bytes
};

/// A camera and the part of its picture to draw, in pixels; rows count from the lower end, as CameraRecord's.
struct SplatView {
    gpu::CameraRecord camera{};
    uint32_t width = 0, height = 0;         ///< of the whole picture, up to 16384
    uint32_t cropX = 0, cropY = 0;          ///< what lies outside is left as it is
    uint32_t cropWidth = 0, cropHeight = 0; ///< 0: to the end
    bool antialiased = false;               ///< Mip-Splatting's filter instead of 3DGS' dilation
    bool srgb = false; ///< colours are sRGB-encoded, and are made linear before they are blended
};

/// A cloud placed in the scene.
struct SplatInstance {
    std::shared_ptr<const SplatStore> store;
    glm::mat4x3 objectToWorld{1.f};
    int primId = -1, instanceId = -1; ///< for the AOVs
    bool visible = true;
};

/// What the last render() did; milliseconds and blends only after setProfiling(true), blends only where
/// subgroups have eight lanes or more.
struct SplatStatistics {
    uint64_t splats = 0;       ///< of all instances
    uint64_t projected = 0;    ///< of those, the ones of instances that may show in the picture
    uint64_t visible = 0;      ///< projected into the picture
    uint64_t pairs = 0;        ///< (splat, macro-tile), or (splat, tile) in flat modes
    uint64_t largestList = 0;  ///< pairs of one (macro-)tile
    uint64_t batches = 0;      ///< of 1024 splats, or less at the end of a macro-tile; 0 in flat modes
    uint64_t sortBytes = 0;    ///< read and written by sorting
    uint64_t partialBytes = 0; ///< of partial pictures, mode Higs8
    uint64_t blendsTried = 0, blendsDone = 0; ///< (splat, pixel): evaluated; with an alpha of 1/255 or more
    uint64_t attempts = 0;                    ///< 1, and 1 for each time a buffer had to grow
    double totalMs = 0;
    struct Stage {
        const char* name;
        double ms;          ///< on the clock
        double processorMs; ///< of all threads of this process together
    };
    std::vector<Stage> stages; ///< in order
};

/// Not thread-safe. Buffers grow with what is drawn and stay. Throws OutOfMemory and DeviceLost.
class SplatPass {
public:
    /// Compiles the kernels of a mode; those of others are compiled when they are first drawn with.
    explicit SplatPass(Device& device, const SplatPassOptions& options = {});
    ~SplatPass();
    SplatPass(const SplatPass&) = delete;
    SplatPass& operator=(const SplatPass&) = delete;

    void setView(const SplatView& view);
    /// Of splats at equal depths those of earlier instances are in front, and those of smaller index.
    void setInstances(std::vector<SplatInstance> instances);
    /// Moves one of the instances.
    void place(uint32_t instance, const glm::mat4x3& objectToWorld);
    void setMode(SplatMode mode);
    /// The mode render() uses: never Automatic.
    SplatMode mode() const;
    /// `cameraDepths`: address of a float for every pixel of the picture, camera depths (see CameraRecord) of
    /// what is opaque there, 0 where nothing is; splats behind do not contribute. 0: there is nothing opaque.
    /// The whole picture is drawn again, from the lists as they are.
    void setDepthLimit(VkDeviceAddress cameraDepths);
    void setProfiling(bool on);

    /// Draws what has changed; false when `cancel` became true before the end: pixels() is then undefined
    /// until a render() that returns true. Blocks.
    bool render(const std::atomic<bool>* cancel = nullptr);

    /// gpu::SplatPixel[width * height], row by row. Its address may change with the view.
    const Buffer& pixels() const;
    /// Of each macro-tile of the picture, row by row: whether the last render() drew it again.
    const std::vector<uint32_t>& drawnTiles() const;
    /// Macro-tiles of a row of the picture.
    uint32_t tileColumns() const;
    const SplatStatistics& statistics() const;

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

} // namespace hipr
