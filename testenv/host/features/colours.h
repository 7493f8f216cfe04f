/// @file colours.h
/// Colours of test pictures by name.
#pragma once

#include <algorithm>
#include <string>

#include "testenv/host/image_file.h"

namespace hipr::test {

/// "black", or the names of the channels that reach half of the strongest one: "red", "green", "blue",
/// "yellow" (red and green), "magenta", "cyan", "white".
inline std::string colourName(const ImageFile& image, double x, double y) {
    const float r = image.at("R", x, y), g = image.at("G", x, y), b = image.at("B", x, y);
    const float strongest = std::max({r, g, b});
    if (!(strongest > 0.02f)) return "black";
    const int mask = (r > 0.5f * strongest) | (g > 0.5f * strongest) << 1 | (b > 0.5f * strongest) << 2;
    static const char* const names[] = {"black", "red",     "green", "yellow",
                                        "blue",  "magenta", "cyan",  "white"};
    return names[mask];
}

} // namespace hipr::test
