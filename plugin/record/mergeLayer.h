/// @file mergeLayer.h
/// Adds the opinions of one layer to those of another.
#pragma once

#include "pxr/pxr.h"
#include "pxr/usd/sdf/layer.h"

namespace hipr::record {

/// Adds everything in `from` to `into`, where `from` wins. Dictionaries, variant selections, time samples and
/// list edits are combined; an `over` leaves a `def` that is there defined; a default value replaces time
/// samples, which would hide it. Listeners are told of what differs only (UsdUtilsStitchLayers would build
/// the whole layer anew, and have `over` win over `def`).
void mergeLayer(const PXR_NS::SdfLayerHandle& from, const PXR_NS::SdfLayerHandle& into);

} // namespace hipr::record
