/// @file splatSchema.h
/// The names of UsdVol's ParticleField3DGaussianSplat (OpenUSD 26.03), which older OpenUSD gets from us.
#pragma once

#include "pxr/base/tf/token.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A property in single precision and the same in half precision. The first is also the name of the primvar.
struct UsdSplatProperty {
    TfToken name;
    TfToken half;  ///< empty: there is none
    bool constant; ///< one value for all splats
};

/// Those that become primvars.
inline UsdSplatProperty const (&UsdSplatProperties())[8] {
    static const UsdSplatProperty properties[] = {
        {TfToken("positions"), TfToken("positionsh"), false},
        {TfToken("orientations"), TfToken("orientationsh"), false},
        {TfToken("scales"), TfToken("scalesh"), false},
        {TfToken("opacities"), TfToken("opacitiesh"), false},
        {TfToken("radiance:sphericalHarmonicsCoefficients"),
         TfToken("radiance:sphericalHarmonicsCoefficientsh"), false},
        {TfToken("radiance:sphericalHarmonicsDegree"), TfToken(), true},
        {TfToken("sortingModeHint"), TfToken(), true},
        {TfToken("projectionModeHint"), TfToken(), true},
    };
    return properties;
}

PXR_NAMESPACE_CLOSE_SCOPE
