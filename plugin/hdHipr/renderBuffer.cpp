#include "plugin/hdHipr/renderBuffer.h"

#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/pixelFormat.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

std::string sizeText(GfVec3i const& size) {
    return std::to_string(size[0]) + " x " + std::to_string(size[1]) + " x " + std::to_string(size[2]) +
           " pixels";
}

} // namespace

HdHiprRenderBuffer::HdHiprRenderBuffer(SdfPath const& id) : HdRenderBuffer(id) {}

bool HdHiprRenderBuffer::Allocate(GfVec3i const& dimensions, HdFormat format, bool multiSampled) {
    _Deallocate();
    if (dimensions[2] != 1 || dimensions[0] < 0 || dimensions[1] < 0 || !writableFormat(format)) {
        warnOnce(GetId().GetString(), "cannot allocate a render buffer of " + sizeText(dimensions) +
                                          " in format " + std::to_string(int(format)));
        return false;
    }
    std::vector<uint8_t> front, back;
    try {
        back.assign(size_t(dimensions[0]) * size_t(dimensions[1]) * HdDataSizeOfFormat(format), 0);
        front = back;
    } catch (std::exception const&) { // the size does not even fit a vector, or there is no memory
        warnOnce(GetId().GetString(), "there is no memory for a render buffer of " + sizeText(dimensions));
        return false;
    }
    std::lock_guard<std::mutex> lock(_mutex);
    ++_allocation;
    _width = unsigned(dimensions[0]);
    _height = unsigned(dimensions[1]);
    _format = format;
    _multiSampled = multiSampled;
    _back = std::move(back);
    _front = std::move(front);
    _newer = false;
    _converged.store(false);
    return true;
}

void HdHiprRenderBuffer::_Deallocate() {
    std::lock_guard<std::mutex> lock(_mutex);
    _width = _height = 0;
    _format = HdFormatInvalid;
    _back = {};
    _front = {};
    _newer = false;
    _converged.store(false);
}

void* HdHiprRenderBuffer::Map() {
    std::lock_guard<std::mutex> lock(_mutex);
    bringNewest();
    ++_mapCount;
    return _front.data();
}

void HdHiprRenderBuffer::Unmap() {
    if (_mapCount.load() > 0) {
        --_mapCount;
    }
}

void HdHiprRenderBuffer::Resolve() {
    std::lock_guard<std::mutex> lock(_mutex);
    bringNewest();
}

void HdHiprRenderBuffer::bringNewest() {
    if (!_newer || _mapCount.load() > 0) {
        return;
    }
    _front.swap(_back);
    _back.resize(_front.size());
    _newer = false;
}

void HdHiprRenderBuffer::fill(VtValue const& value) {
    const GfVec4f components = clearComponents(value);
    const HdFormat componentFormat = HdGetComponentFormat(_format);
    const size_t count = HdGetComponentCount(_format), bytes = HdDataSizeOfFormat(_format);
    if (_back.empty()) {
        return;
    }
    for (size_t c = 0; c < count; ++c) {
        writeComponent(componentFormat, _back.data(), c, components[c]);
    }
    for (size_t done = bytes; done < _back.size();) { // doubles the filled part
        const size_t n = std::min(done, _back.size() - done);
        std::memcpy(_back.data() + done, _back.data(), n);
        done += n;
    }
}

void HdHiprRenderBuffer::clear(VtValue const& value) {
    std::lock_guard<std::mutex> lock(_mutex);
    fill(value);
    _newer = true;
}

void HdHiprRenderBuffer::write(PixelRect const& rect, const void* data, uint32_t components, bool integer,
                               VtValue const& outside) {
    std::lock_guard<std::mutex> lock(_mutex);
    if (_back.empty()) {
        return;
    }
    const int x0 = std::max(rect.x, 0), x1 = std::min(rect.x + rect.width, int(_width));
    const int y0 = std::max(rect.y, 0), y1 = std::min(rect.y + rect.height, int(_height));
    if (x0 > 0 || y0 > 0 || x1 < int(_width) || y1 < int(_height)) {
        fill(outside);
    }

    const HdFormat componentFormat = HdGetComponentFormat(_format);
    const size_t count = HdGetComponentCount(_format), bytes = HdDataSizeOfFormat(_format);
    const bool sameLayout =
        count == components && componentFormat == (integer ? HdFormatInt32 : HdFormatFloat32);
    const float* floats = static_cast<const float*>(data);
    const int32_t* ints = static_cast<const int32_t*>(data);
    for (int y = y0; y < y1 && x0 < x1; ++y) {
        const size_t source = (size_t(y - rect.y) * rect.width + size_t(x0 - rect.x)) * components;
        uint8_t* pixel = _back.data() + (size_t(y) * _width + x0) * bytes;
        if (sameLayout) {
            std::memcpy(pixel, floats + source, size_t(x1 - x0) * bytes);
            continue;
        }
        for (size_t at = source, end = source + size_t(x1 - x0) * components; at < end; at += components) {
            for (size_t c = 0; c < count; ++c) {
                const double value = c >= components ? 0.0
                                     : integer       ? double(ints[at + c])
                                                     : double(floats[at + c]);
                writeComponent(componentFormat, pixel, c, value);
            }
            pixel += bytes;
        }
    }
    _newer = true;
}

PXR_NAMESPACE_CLOSE_SCOPE
