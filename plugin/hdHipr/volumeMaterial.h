/// @file volumeMaterial.h
/// Volume terminals of material networks -> how volumes look.
#pragma once

#include <optional>

#include "pxr/imaging/hd/material.h"
#include "pxr/pxr.h"
#include "renderer/api/volume.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The look that a material's volume terminal describes: MaterialX's `volume` of an `anisotropic_vdf` or an
/// `absorption_vdf` and a `uniform_edf`, whose inputs are constants; what else there is is named once and
/// ignored. Nothing if the material has no volume terminal that is understood.
std::optional<hipr::VolumeLook> volumeLook(SdfPath const& material, HdMaterialNetworkMap const& networks);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
