/// @file view.h
/// From scene-linear pixels to what a screen or an 8-bit file shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "renderer/color/color.h"

namespace hipr {

/// Which view of which display; empty: the configuration's default. The built-in configuration has the
/// display "sRGB" with the views "sRGB" (the plain sRGB curve, default), "ACES" (ACES 1.0 SDR video tone
/// curve) and "Raw".
struct ViewTransformDesc {
    std::string display, view;
    float exposure = 0.f; ///< stops, applied before the view
};

/// Maps linear Rec.709 to display values. Immutable and thread-safe.
class ViewTransform {
public:
    /// Returns null, with a reason that lists what exists in `error`, for an unknown display or view.
    static std::shared_ptr<const ViewTransform> create(std::shared_ptr<const ColorManager> color,
                                                       const ViewTransformDesc& desc, std::string* error);
    ~ViewTransform();

    /// `pixels` premultiplied linear RGBA values to RGBA8. Colours are divided by alpha before the view and
    /// written unassociated, as PNG wants. NaN reads as 0; values outside [0, 1] after the view are clamped.
    void apply(const float* rgba, uint8_t* rgba8, size_t pixels) const;

    /// Names of all views as "display/view".
    static std::vector<std::string> names(const ColorManager& color);

private:
    ViewTransform();
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

} // namespace hipr
