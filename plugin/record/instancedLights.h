/// @file instancedLights.h
/// Tells of lights that Hydra does not hand over.
#pragma once

#include "pxr/pxr.h"
#include "pxr/usd/usd/stage.h"

namespace hipr::record {

/// Names a light inside native instances or the prototypes of a point instancer, and how many there are:
/// before OpenUSD 23.08 UsdImaging hands over one light in the place of those of all instances, without their
/// transforms. Says nothing from then on.
void warnOfInstancedLights(const PXR_NS::UsdStageRefPtr& stage);

} // namespace hipr::record
