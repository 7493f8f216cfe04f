/// @file splatSchema.h
/// The names of UsdVol's ParticleField3DGaussianSplat (OpenUSD 26.03), which older OpenUSD gets from us.
#pragma once

#include "plugin/hdHipr/splatCloud.h"

PXR_NAMESPACE_OPEN_SCOPE

/// A property in single precision and the same in half precision. The first is also the name of the primvar.
struct UsdSplatProperty {
    TfToken name;
    TfToken half;  ///< empty: there is none
    bool constant; ///< one value for all splats
};

/// Those that become primvars.
inline UsdSplatProperty const (&UsdSplatProperties())[8] {
    static const hdhipr::SplatTokens t;
    static const UsdSplatProperty properties[] = {
        {t.positions, TfToken("positionsh"), false},
        {t.orientations, TfToken("orientationsh"), false},
        {t.scales, TfToken("scalesh"), false},
        {t.opacities, TfToken("opacitiesh"), false},
        {t.coefficients, TfToken(t.coefficients.GetString() + "h"), false},
        {t.degree, TfToken(), true},
        {t.sorting, TfToken(), true},
        {t.projection, TfToken(), true},
    };
    return properties;
}

PXR_NAMESPACE_CLOSE_SCOPE
