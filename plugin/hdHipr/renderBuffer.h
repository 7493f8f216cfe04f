/// @file renderBuffer.h
/// HdHiprRenderBuffer: pixels of one AOV, from the render thread to the host.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include "plugin/hdHipr/compat.h"
#include "pxr/imaging/hd/renderBuffer.h"

PXR_NAMESPACE_OPEN_SCOPE

/// Two images: the render thread writes whole frames into the one, the host maps the other. Resolve (or the
/// first Map) brings the newest whole frame to the host, so that a reader never sees a part of one.
class HdHiprRenderBuffer final : public HdRenderBuffer {
public:
    explicit HdHiprRenderBuffer(SdfPath const& id);

    /// Any 2D size, also an empty one, and any component format of HdFormat up to 32 bits. The content is
    /// zero.
    bool Allocate(GfVec3i const& dimensions, HdFormat format, bool multiSampled) override;
    unsigned int GetWidth() const override { return _width; }
    unsigned int GetHeight() const override { return _height; }
    unsigned int GetDepth() const override { return 1; }
    HdFormat GetFormat() const override { return _format; }
    bool IsMultiSampled() const override { return _multiSampled; }

    void* Map() override;
    void Unmap() override;
    bool IsMapped() const override { return _mapCount.load() > 0; }
    void Resolve() override;

    /// True once the last pixel of a converged picture has been written.
    bool IsConverged() const override { return _converged.load(); }
    void setConverged(bool converged) { _converged.store(converged); }

    /// Whether the host has brought the newest picture to itself with Resolve() or Map().
    bool taken() const {
        std::lock_guard<std::mutex> lock(_mutex);
        return !_newer;
    }

    /// Counts the calls of Allocate: the same buffer with another number is an empty one.
    unsigned int allocation() const { return _allocation; }

    /// Fills the picture with a value (an empty one: zero).
    void clear(VtValue const& value);

    /// Replaces the picture by `rect` of a `components`-wide image of rect's size, rows bottom-up; pixels
    /// outside of `rect` become `outside`. `data` points to floats, or to ints when `integer`.
    void write(hdhipr::PixelRect const& rect, const void* data, uint32_t components, bool integer,
               VtValue const& outside);

protected:
    void _Deallocate() override;

private:
    void fill(VtValue const& value);
    void bringNewest();

    mutable std::mutex _mutex;   ///< guards everything below
    std::vector<uint8_t> _back;  ///< the newest whole frame
    std::vector<uint8_t> _front; ///< what the host maps
    bool _newer = false;         ///< _back is newer than _front
    unsigned int _width = 0, _height = 0;
    HdFormat _format = HdFormatInvalid;
    bool _multiSampled = false;
    unsigned int _allocation = 0;
    std::atomic<int> _mapCount{0};
    std::atomic<bool> _converged{false};
};

PXR_NAMESPACE_CLOSE_SCOPE
