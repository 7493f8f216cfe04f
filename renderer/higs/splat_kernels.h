/// @file splat_kernels.h
/// The kernels of the splat pass by name.
#pragma once

#include <array>
#include <optional>

#include "renderer/vulkan/kernel.h"

namespace hipr {

enum class SplatKernel {
    Project, ///< splats -> ellipses
    Touch,   ///< marks the tiles that some splats meet
    Count,   ///< lists' lengths, by chunk in lanes
    Offsets, ///< lanes: where the chunks' splats begin in the lists
    Tiles,   ///< where the lists begin; sizes of what follows
    Fill,    ///< lists
    Sort,    ///< batches of lists
    Merge,   ///< batches -> sorted lists
    Mask,    ///< which pairs hit which render tiles
    Raster,  ///< lists with masks -> pixels
    Number
};

/// Kernels of one form.
class SplatKernelSet {
public:
    /// `lanes`: the form without barriers and shared memory; `half`: projected splats in half precision.
    SplatKernelSet(Device& device, bool lanes, bool half) : _device(device), _lanes(lanes), _half(half) {}
    /// Compiles what is not compiled yet (blocking).
    void compile(std::initializer_list<SplatKernel> kernels);
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
