/// @file lightParams.h
/// Reading what a light says.
#pragma once

#include "plugin/hdHipr/compat.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Reads parameters of one light; an absent one, or one of a type that cannot be cast, keeps the default.
struct LightParams {
    HdSceneDelegate* delegate;
    SdfPath const& id;

    template <class T> T get(const char* name, T const& fallback) const {
        const VtValue value = VtValue::Cast<T>(lightParam(delegate, id, TfToken(name)));
        return value.IsHolding<T>() ? value.template UncheckedGet<T>() : fallback;
    }
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
