/// @file aovLayers.h
/// How AOVs are named inside a multi-layer EXR.
#pragma once

#include <string>
#include <vector>

namespace hipr::record {

/// EXR channel names of an AOV with 1 to 4 components:
///   color                       R G B A (the main layer, without a prefix)
///   depth, cameraDepth          <aov>.Z
///   normal, Neye, Peye, ...     <aov>.X <aov>.Y <aov>.Z
///   other float vectors         <aov>.R <aov>.G <aov>.B <aov>.A
///   other single floats         <aov>.V
///   ids and counts (integers)   <aov>.I
/// ':' becomes '.', so "primvars:st" is the layer "primvars.st". `layer` stands for <aov> where it is not
/// empty; the layer "color" is the main one.
std::vector<std::string> aovChannelNames(const std::string& aov, int components, bool integer,
                                         const std::string& layer = {});

/// Whether an AOV is a colour, which 16 bits are enough for: no depth, position, direction, id or matte.
bool isColour(const std::string& aov, int components);

} // namespace hipr::record
