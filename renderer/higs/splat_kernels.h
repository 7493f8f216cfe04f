/// @file splat_kernels.h
/// The kernels of the splat pass by name.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "renderer/vulkan/kernel.h"

namespace hipr {

enum class SplatKernel {
    Project,       ///< splats -> ellipses
    Touch,         ///< marks the tiles that some splats meet
    Count,         ///< lists' lengths, by chunk in lanes
    Offsets,       ///< lanes: where the chunks' splats begin in the lists
    Tiles,         ///< where the lists begin; sizes of what follows
    Fill,          ///< lists
    Sort,          ///< batches of lists
    Merge,         ///< batches -> sorted lists
    Mask,          ///< which pairs hit which render tiles
    Raster,        ///< lists with masks -> pixels
    RasterLimited, ///< the same, but for what lies behind SplatFrame::depthLimit; like all that say so
    Partial,       ///< mode higs8: batches -> partial pictures
    PartialLimited,
    Compose, ///< partial pictures -> pixels
    ComposeLimited,
    Tally, ///< counts the blends of Raster
    TallyPartial,
    FlatCount,  ///< flat modes: pairs of the chunks of splats
    FlatPairs,  ///< where the chunks' pairs begin
    FlatFill,   ///< all pairs
    FlatDigits, ///< counts one digit of the pairs
    FlatScan,   ///< where pairs with that digit go
    FlatMove,   ///< moves them there
    FlatTiles,  ///< where the tiles' lists begin and end
    FlatRaster, ///< lists -> pixels
    FlatRasterLimited,
    FlatTally,
    Number
};

/// Whether a device can run the kernels in lanes: they want subgroups of eight or more that can shuffle.
bool canRunLanes(const Device& device);

/// Kernels of one form.
class SplatKernelSet {
public:
    /// `lanes`: the form without barriers and shared memory; `half`: projected splats in half precision.
    SplatKernelSet(Device& device, bool lanes, bool half) : _device(device), _lanes(lanes), _half(half) {}
    /// Compiles what is not compiled yet (blocking).
    void compile(const std::vector<SplatKernel>& kernels);
    /// A compiled kernel.
    const Kernel& operator[](SplatKernel kernel) const { return *_kernels[size_t(kernel)]; }
    bool lanes() const { return _lanes; }
    bool half() const { return _half; }

private:
    Device& _device;
    const bool _lanes, _half;
    std::array<std::optional<Kernel>, size_t(SplatKernel::Number)> _kernels;
};

} // namespace hipr
