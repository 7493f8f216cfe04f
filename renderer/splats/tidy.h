/// @file tidy.h
/// What every source of splats has in common before they are rendered.
#pragma once

#include "renderer/api/splats.h"

namespace hipr {

/// Leaves out splats with numbers that are not finite or an orientation of length 0, makes orientations unit
/// length and scales positive, and clamps opacities to 0..1; one message tells how many were wrong, and how.
/// Each array has to be empty or of the length that SplatCloud asks for.
void tidySplats(SplatCloud& cloud, const MessageSink& messages);

} // namespace hipr
