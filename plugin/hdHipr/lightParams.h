/// @file lightParams.h
/// Reading what a light says.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "renderer/api/light.h"

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

hipr::LightShaping readShaping(LightParams const& params);
hipr::LightShadow readShadow(LightParams const& params);
/// The category of objects that a link, `lightLink` or `shadowLink`, means; empty: all.
std::string readLink(LightParams const& params, const char* name);
/// The group by which light path expressions know a light, under the names that hosts write.
std::string readLightGroup(LightParams const& params);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
