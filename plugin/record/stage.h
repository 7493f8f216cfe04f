/// @file stage.h
/// The scene side of a recording: opening a stage, finding its cameras, framing it.
#pragma once

#include <string>
#include <vector>

#include "pxr/pxr.h"
#include "pxr/usd/sdf/path.h"
#include "pxr/usd/usd/stage.h"
#include "pxr/usd/usd/timeCode.h"

namespace hipr::record {

/// What decides which part of the stage is looked at.
struct ViewRequest {
    std::string camera; ///< a prim path, a prim name, "auto" to frame the stage, or empty for the default
    int width = 0, height = 0; ///< pixels; 0 follows from the other one and the camera, or is 960 wide
    std::vector<std::string> purposes; ///< "default", "render", "proxy", "guide"
};

/// The camera that was chosen and the size of the picture.
struct View {
    PXR_NS::SdfPath camera;
    bool automatic = false; ///< whether the camera was made by framing the stage
    int width = 0, height = 0;
};

/// Opens a stage with everything loaded; with `mask`, only those prims, their ancestors and descendants.
/// Throws Failure with ExitStage.
PXR_NS::UsdStageRefPtr openStage(const std::string& path, const std::vector<std::string>& mask);

/// Paths of all cameras, in stage order.
std::vector<PXR_NS::SdfPath> listCameras(const PXR_NS::UsdStageRefPtr& stage);

/// Chooses the camera: the requested one; else the camera of the stage's render settings; else the first
/// camera of the stage; else one that frames the shapes of the requested purposes at `time`, which is added
/// to the session layer. Throws Failure with ExitCamera, which lists what cameras there are.
View chooseView(const PXR_NS::UsdStageRefPtr& stage, const ViewRequest& request, PXR_NS::UsdTimeCode time);

/// The time of a recording without frames: the authored start of the stage, else 0.
double defaultFrame(const PXR_NS::UsdStageRefPtr& stage);

} // namespace hipr::record
