/// @file cull.h
/// Which sides of faces the camera sees.
#pragma once

#include <cstdint>

namespace hipr {

/// Faces that are culled are as if they were not there for the camera, with whatever it sees behind them;
/// light meets them as ever. Front faces are those whose corners go round counter-clockwise.
enum class CullStyle : uint32_t {
    Inherit, ///< of an object: the view's; of a view: as Nothing
    Nothing,
    Back,
    Front,
    BackUnlessDoubleSided,
    FrontUnlessDoubleSided,
    BackAndForLight, ///< as Back, and light passes back faces too: for faces that lie back to back
};

} // namespace hipr
