#include "plugin/record/dataWindow.h"

#include <cmath>
#include <cstdio>

#include "plugin/record/failure.h"
#include "pxr/base/tf/stringUtils.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

DataWindow dataWindowOf(const GfVec4f& ndc, int width, int height) {
    // What single precision adds to a whole number of pixels is no pixel.
    const auto pixel = [](float part, int size) { return std::ceil(double(part) * size - 1e-3); };
    const double left = pixel(ndc[0], width), right = pixel(ndc[2], width);
    const double bottom = pixel(ndc[1], height), top = pixel(ndc[3], height);
    constexpr double largest = 65536;
    const bool fits = right > left && top > bottom && right - left <= largest && top - bottom <= largest &&
                      std::abs(left) <= largest && std::abs(top) <= largest;
    if (!fits)
        throw Failure(ExitUsage,
                      TfStringPrintf("the data window (%g, %g, %g, %g) has no pixels, or too many, "
                                     "in a picture of %d x %d: it is (xmin, ymin, xmax, ymax) in "
                                     "parts of the picture, from its bottom left",
                                     ndc[0], ndc[1], ndc[2], ndc[3], width, height));
    return {int(left), int(height - top), int(right - left), int(top - bottom)};
}

GfVec4f parseDataWindow(const std::string& text) {
    GfVec4f ndc;
    int end = 0;
    const int count = std::sscanf(text.c_str(), "%f,%f,%f,%f%n", &ndc[0], &ndc[1], &ndc[2], &ndc[3], &end);
    if (count != 4 || size_t(end) != text.size())
        throw Failure(ExitUsage, "--crop: '" + text + "' is not of the form XMIN,YMIN,XMAX,YMAX");
    return ndc;
}

} // namespace hipr::record
