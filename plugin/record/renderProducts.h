/// @file renderProducts.h
/// RenderSettings, RenderProduct and RenderVar prims of a stage as work for the recorder.
#pragma once

#include <vector>

#include "plugin/record/options.h"
#include "pxr/usd/usd/stage.h"

namespace hipr::record {

struct Recordings {
    std::vector<Options> options; ///< one recording each
    PXR_NS::UsdStageRefPtr stage; ///< while it lives, opening the scene again reads no file
};

/// What render settings make of the command line: options that name a RenderSettings prim, or no output,
/// become those of one recording for each camera and size of its products; others stay as they are. What is
/// on the command line wins. Without an output of its own the RenderSettings prim is that which the stage
/// names. Product types that the recorder cannot do are said. Throws Failure
/// with ExitUsage when there is nothing to render.
Recordings recordingsOf(const Options& options);

} // namespace hipr::record
