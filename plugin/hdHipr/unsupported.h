/// @file unsupported.h
/// What a prim or a view asks for and does not get: named once, so that nobody wonders at the picture.
#pragma once

#include "plugin/hdHipr/compat.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Warns when a prim's `points` move while the shutter is open. Reads samples: call it only while a shutter
/// is open.
void warnOfMotion(HdSceneDelegate& delegate, SdfPath const& id, TfToken const& points);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
