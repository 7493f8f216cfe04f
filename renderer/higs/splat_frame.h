/// @file splat_frame.h
/// What a frame of the splat pass works on: placements of clouds, buffers, and the record that holds them.
#pragma once

#include "renderer/higs/splat_pass.h"

namespace hipr {

/// The binning grid of a mode, in pixels.
glm::uvec2 binSize(SplatMode mode);
/// Whether all pairs of a mode are sorted at once, by tile first.
bool isFlat(SplatMode mode);

/// An instance as the kernels see it; `first` is the index of its first splat among all. Works in double
/// precision. Instances that cannot be seen (a matrix without inverse) are hidden.
gpu::SplatPlacement splatPlacement(const SplatInstance& instance, const SplatView& view, uint32_t first);

/// Whether any splat of an instance may show: false only where none does. Looks at its bounds alone.
bool mayShow(const SplatInstance& instance, const SplatView& view);

/// Blocks of clouds of so many splats, SPLAT_BLOCK splats each, and where each cloud's begin.
struct SplatBlocks {
    std::vector<gpu::SplatBlock> blocks;
    std::vector<uint32_t> firstBlock, firstSplat; ///< one more than clouds
};
SplatBlocks splatBlocks(const std::vector<size_t>& sizes);

/// A buffer that grows and never shrinks.
class GrowingBuffer {
public:
    GrowingBuffer(const char* kind, MemoryUse use = MemoryUse::Device) : _kind(kind), _use(use) {}
    /// Makes it hold `bytes`; what it held is lost when it grows.
    void reserve(Device& device, uint64_t bytes) {
        if (_buffer && _buffer.bytes() >= bytes) return;
        _buffer = Buffer(); // first, so that both are never there at once
        _buffer = device.createBuffer(bytes, _use, _kind);
    }
    const Buffer& buffer() const { return _buffer; }
    VkDeviceAddress address() const { return _buffer.address(); }

private:
    const char* _kind;
    MemoryUse _use;
    Buffer _buffer;
};

/// The buffers of a pass, sized for its frames.
class SplatBuffers {
public:
    SplatBuffers(Device& device, bool lanes, bool half) : _device(device), _lanes(lanes), _half(half) {}

    /// Makes room for what is known before a frame and writes the record's addresses and sizes; keeps the
    /// contents of `splats` when their number has not changed.
    void prepare(SplatMode mode, gpu::SplatFrame& frame);
    /// Makes room for lists of `pairs`, gaps included, in `batches`; prepare() tells the frame.
    void reserveLists(uint64_t pairs, uint64_t batches);
    uint64_t histogramBytes(const gpu::SplatFrame& frame) const;

    GrowingBuffer placements{"splat frame"}, blocks{"splat frame"}, splats{"splat frame"},
        reaches{"splat frame"}, rays{"splat frame"}, histogram{"splat frame"}, tiles{"splat frame"},
        tileMask{"splat frame"}, masks{"splat lists"}, partials{"splat partial pictures"},
        pixels{"splat pixels"}, emptied{"splat frame"}, state{"splat frame"}, camera{"splat frame"},
        blends{"splat frame"}, frame{"splat frame"};
    GrowingBuffer pairs[2] = {{"splat lists"}, {"splat lists"}};
    GrowingBuffer tilePairs[2] = {{"splat lists"}, {"splat lists"}};

private:
    void prepareLists(SplatMode mode, gpu::SplatFrame& frame);

    Device& _device;
    const bool _lanes, _half;
    uint64_t _pairCapacity = 0, _batchCapacity = 0;
};

} // namespace hipr
