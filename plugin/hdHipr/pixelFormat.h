/// @file pixelFormat.h
/// Conversion of one pixel from the renderer's floats or ints to a Hydra buffer format.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "pxr/base/gf/half.h"
#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/types.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Whether `writeComponent` knows the format's components.
inline bool writableFormat(HdFormat format) {
    switch (HdGetComponentFormat(format)) {
    case HdFormatUNorm8:
    case HdFormatSNorm8:
    case HdFormatFloat16:
    case HdFormatFloat32:
    case HdFormatInt32:
        return true;
    default:
        return false;
    }
}

/// Stores component `c` of a pixel. Normalised formats are clamped and rounded, ints are rounded; NaN becomes
/// 0 there, because a conversion of NaN to an integer has no defined result.
inline void writeComponent(HdFormat componentFormat, uint8_t* pixel, size_t c, double value) {
    const auto rounded = [value](double low, double high, double scale) {
        return std::isnan(value) ? 0.0 : std::round(std::clamp(value, low, high) * scale);
    };
    switch (componentFormat) {
    case HdFormatUNorm8:
        pixel[c] = uint8_t(rounded(0.0, 1.0, 255.0));
        break;
    case HdFormatSNorm8:
        reinterpret_cast<int8_t*>(pixel)[c] = int8_t(rounded(-1.0, 1.0, 127.0));
        break;
    case HdFormatFloat16: {
        const uint16_t bits = GfHalf(float(value)).bits();
        std::memcpy(pixel + 2 * c, &bits, sizeof bits);
        break;
    }
    case HdFormatInt32: {
        const int32_t word = int32_t(rounded(-2147483648.0, 2147483647.0, 1.0));
        std::memcpy(pixel + 4 * c, &word, sizeof word);
        break;
    }
    default: {
        const float word = float(value);
        std::memcpy(pixel + 4 * c, &word, sizeof word);
        break;
    }
    }
}

/// The components of a clear value: a number, a vector of floats, or nothing (zeros).
inline GfVec4f clearComponents(VtValue const& value) {
    if (value.IsHolding<GfVec4f>()) {
        return value.UncheckedGet<GfVec4f>();
    }
    if (value.IsHolding<GfVec3f>()) {
        const GfVec3f v = value.UncheckedGet<GfVec3f>();
        return GfVec4f(v[0], v[1], v[2], 0.f);
    }
    if (value.IsHolding<GfVec2f>()) {
        const GfVec2f v = value.UncheckedGet<GfVec2f>();
        return GfVec4f(v[0], v[1], 0.f, 0.f);
    }
    if (value.IsHolding<int>()) {
        return GfVec4f(float(value.UncheckedGet<int>()));
    }
    if (value.IsHolding<float>()) {
        return GfVec4f(value.UncheckedGet<float>());
    }
    if (value.IsHolding<double>()) {
        return GfVec4f(float(value.UncheckedGet<double>()));
    }
    return GfVec4f(0.f);
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
