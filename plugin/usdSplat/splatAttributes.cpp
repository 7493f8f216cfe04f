#include "plugin/usdSplat/splatAttributes.h"

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

bool UsdSplatIsProperty(TfToken const& name) {
    for (UsdSplatProperty const& property : UsdSplatProperties()) {
        if (name == property.name || name == property.half) {
            return true;
        }
    }
    return false;
}

PXR_NAMESPACE_CLOSE_SCOPE
