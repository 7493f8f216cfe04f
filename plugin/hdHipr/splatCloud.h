/// @file splatCloud.h
/// Hydra values -> the renderer's clouds of splats.
#pragma once

#include <functional>
#include <memory>

#include "plugin/hdHipr/compat.h"
#include "renderer/api/splats.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The names under which UsdImaging hands over ParticleField3DGaussianSplat; half arrays come under them,
/// too. The two hints are passed only by the UsdImaging adapter of usdSplat.
struct SplatTokens {
    const TfToken positions{"positions"}, orientations{"orientations"}, scales{"scales"},
        opacities{"opacities"}, degree{"radiance:sphericalHarmonicsDegree"},
        coefficients{"radiance:sphericalHarmonicsCoefficients"}, sorting{"sortingModeHint"},
        projection{"projectionModeHint"};
};

TfTokenVector const& splatPrimvarNames();

/// The value of a name of SplatTokens; empty where there is none.
using SplatValues = std::function<VtValue(TfToken const&)>;

/// Reads all values of a cloud. As many splats as there are positions; longer arrays are cut, shorter ones
/// are left out, as UsdVol says. What does not fit, or is no splat, is told once with `name`, the prim's
/// path.
std::shared_ptr<const hipr::SplatCloud> readSplatCloud(std::string const& name, SplatValues const& values);
/// The same for the primvars that a host lists.
std::shared_ptr<const hipr::SplatCloud> readSplatCloud(HdSceneDelegate& delegate, SdfPath const& id);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
