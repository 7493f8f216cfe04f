/// @file dataWindow.h
/// The part of a picture that is rendered: less than all of it (a crop), or more (overscan).
#pragma once

#include <string>

#include "pxr/base/gf/vec4f.h"
#include "pxr/pxr.h"

namespace hipr::record {

/// Pixels of a picture whose top left one is (0, 0); may reach beyond it.
struct DataWindow {
    int x = 0, y = 0, width = 0, height = 0;
    bool isAllOf(int pictureWidth, int pictureHeight) const {
        return x == 0 && y == 0 && width == pictureWidth && height == pictureHeight;
    }
};

/// The pixels of UsdRender's dataWindowNDC, (xmin, ymin, xmax, ymax) with (0, 0) at the picture's bottom left
/// and (1, 1) at its top right: from ceil(min * size) to before ceil(max * size), so that windows that touch
/// share no pixel. Throws Failure with ExitUsage where that is no pixel, or more than 65536 a side.
DataWindow dataWindowOf(const PXR_NS::GfVec4f& ndc, int width, int height);

/// "XMIN,YMIN,XMAX,YMAX". Throws Failure with ExitUsage.
PXR_NS::GfVec4f parseDataWindow(const std::string& text);

} // namespace hipr::record
