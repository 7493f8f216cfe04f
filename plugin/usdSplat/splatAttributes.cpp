#include "plugin/usdSplat/splatAttributes.h"

#include <algorithm>

#include "pxr/base/tf/stringUtils.h"

PXR_NAMESPACE_OPEN_SCOPE

UsdAttribute UsdSplatAttribute(UsdPrim const& prim, TfToken const& name) {
    for (UsdSplatProperty const& property : UsdSplatProperties()) {
        if (property.name != name) {
            continue;
        }
        const UsdAttribute single = prim.GetAttribute(property.name);
        if (single && single.HasValue()) {
            return single;
        }
        const UsdAttribute half = property.half.IsEmpty() ? UsdAttribute() : prim.GetAttribute(property.half);
        return half && half.HasValue() ? half : UsdAttribute();
    }
    return UsdAttribute();
}

std::string UsdSplatFieldFault(UsdPrim const& field) {
    // As authored: before 26.03 USD does not know these schemas.
    TfTokenVector const& applied = field.GetPrimTypeInfo().GetAppliedAPISchemas();
    const std::string kernels = "ParticleFieldKernel", ellipsoids = kernels + "GaussianEllipsoidAPI";
    for (TfToken const& api : applied) {
        if (TfStringStartsWith(api.GetString(), kernels) && api != ellipsoids) {
            return "has particles of another kernel, " + api.GetString();
        }
    }
    for (std::string const& needed : {std::string("ParticleFieldPositionAttributeAPI"), ellipsoids,
                                      std::string("ParticleFieldSphericalHarmonicsAttributeAPI")}) {
        const bool has =
            std::any_of(applied.begin(), applied.end(), [&](TfToken const& api) { return api == needed; });
        if (!has) {
            return "does not apply " + needed;
        }
    }
    return "";
}

bool UsdSplatIsProperty(TfToken const& name) {
    for (UsdSplatProperty const& property : UsdSplatProperties()) {
        if (name == property.name || name == property.half) {
            return true;
        }
    }
    return false;
}

PXR_NAMESPACE_CLOSE_SCOPE
