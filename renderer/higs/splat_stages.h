/// @file splat_stages.h
/// The stages of the splat pass, one function each. SplatPass puts them together; tests look between them.
#pragma once

#include "renderer/higs/splat_frame.h"
#include "renderer/higs/splat_kernels.h"

namespace hipr {

/// Records stages into command buffers; the caller puts a computeBarrier() between them. The order is that of
/// the functions. All buffers are sized by setUp(), but for the lists: when state() says overflow, nothing
/// was listed or drawn, and makeRoom() and another count() to raster() are due.
class SplatStages {
public:
    /// `lanes`: kernels without barriers and shared memory; `half`: projected splats in half precision.
    SplatStages(Device& device, bool lanes, bool half);

    /// Compiles what a mode needs and what is not there yet (blocking); `limited`: with a depth limit,
    /// `profiling`: with tally().
    void compile(SplatMode mode, bool limited, bool profiling);
    /// What the frame is about. Compiles what is missing for it and uploads everything; `frame` comes with
    /// its sizes, flags and depthLimit set, the rest is filled in here.
    void setUp(SplatMode mode, gpu::SplatFrame frame, const std::vector<gpu::SplatPlacement>& placements,
               const std::vector<gpu::SplatBlock>& blocks, const gpu::CameraRecord& camera);

    /// Resets counters; every tile is to be drawn, or none until touch() says so.
    void clear(VkCommandBuffer cmd, bool drawAll) const;
    void clearState(VkCommandBuffer cmd) const;
    /// Forgets which pixels show nothing already: those of a new picture or crop hold anything.
    void forgetEmpty(VkCommandBuffer cmd) const;
    /// Blocks from `first` to before `end`.
    void project(VkCommandBuffer cmd, uint32_t first, uint32_t end) const;
    /// Marks the tiles in which splats of these blocks are for drawing.
    void touch(VkCommandBuffer cmd, uint32_t first, uint32_t end) const;
    void count(VkCommandBuffer cmd) const;
    void scan(VkCommandBuffer cmd) const;
    void fill(VkCommandBuffer cmd) const;
    void sort(VkCommandBuffer cmd) const;
    /// Whether masks() is due: in lanes raster() makes them itself, but in mode higs8.
    bool masksApart() const { return _mode == SplatMode::Higs8 || (!isFlat(_mode) && !_kernels.lanes()); }
    void masks(VkCommandBuffer cmd) const;
    /// Mode higs8: the batches' partial pictures, which raster() composes.
    void partials(VkCommandBuffer cmd) const;
    /// Counts what raster() blends, or partials(), into buffers().blends; `batches`: as state() says.
    void tally(VkCommandBuffer cmd, uint32_t batches) const;
    /// Rows of 8 pixels from `first` on; in modes with macro-tiles both are multiples of a macro-tile's four,
    /// or the end.
    void raster(VkCommandBuffer cmd, uint32_t first, uint32_t rows) const;
    uint32_t pixelRows() const { return (_frame.height + gpu::SPLAT_TILE - 1) / gpu::SPLAT_TILE; }

    gpu::SplatState state() const;
    void makeRoom(const gpu::SplatState& state);

    const gpu::SplatFrame& frame() const { return _frame; }
    const SplatBuffers& buffers() const { return _buffers; }

private:
    void dispatch(VkCommandBuffer cmd, SplatKernel kernel, uint32_t groups, uint32_t first = 0,
                  uint32_t count = 0) const;
    void dispatchIndirect(VkCommandBuffer cmd, SplatKernel kernel, size_t offset, uint32_t first = 0) const;
    void dispatchPixels(VkCommandBuffer cmd, SplatKernel kernel, uint32_t first, uint32_t rows,
                        bool lanes) const;
    void sortFlat(VkCommandBuffer cmd) const;
    uint32_t binGroups() const;

    Device& _device;
    SplatKernelSet _kernels;
    SplatBuffers _buffers;
    SplatMode _mode = SplatMode::Higs8Carry;
    gpu::SplatFrame _frame{};
};

} // namespace hipr
