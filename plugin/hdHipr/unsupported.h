/// @file unsupported.h
/// What a mesh or a view asks for and does not get: named once, so that nobody wonders at the picture.
#pragma once

#include "plugin/hdHipr/compat.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Warns of a cull style that would leave faces out. `subject`: the prim that has it; empty for the view.
void warnOfCullStyle(std::string const& subject, HdCullStyle style);

/// Warns when the transform or the points of a mesh move within the shutter interval. Reads samples of both:
/// call it only while a shutter is open.
void warnOfMotion(HdSceneDelegate& delegate, SdfPath const& id);
/// The same for an instancer and the places of its instances.
void warnOfInstanceMotion(HdSceneDelegate& delegate, SdfPath const& instancer);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
