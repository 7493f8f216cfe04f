#include "plugin/hdHipr/lightParams.h"

#include "plugin/hdHipr/assets.h"
#include "plugin/hdHipr/convert.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

hipr::LightShadow readShadow(LightParams const& params) {
    hipr::LightShadow shadow;
    shadow.enable = params.get("shadow:enable", true);
    shadow.color = toGlm(params.get("shadow:color", GfVec3f(0.f)));
    shadow.distance = params.get("shadow:distance", -1.f);
    shadow.falloff = params.get("shadow:falloff", -1.f);
    shadow.falloffGamma = params.get("shadow:falloffGamma", 1.f);
    return shadow;
}

/// The cone of a light without ShapingAPI is the whole sphere; that of one with it is 90 degrees by default,
/// which Hydra tells.
hipr::LightShaping readShaping(LightParams const& params) {
    hipr::LightShaping shaping;
    shaping.focus = params.get("shaping:focus", 0.f);
    shaping.focusTint = toGlm(params.get("shaping:focusTint", GfVec3f(0.f)));
    shaping.coneAngle = params.get("shaping:cone:angle", 180.f);
    shaping.coneSoftness = params.get("shaping:cone:softness", 0.f);
    shaping.iesFile = assetPath(lightParam(params.delegate, params.id, TfToken("shaping:ies:file")));
    shaping.iesAngleScale = params.get("shaping:ies:angleScale", 0.f);
    shaping.iesNormalize = params.get("shaping:ies:normalize", false);
    return shaping;
}

std::string readLink(LightParams const& params, const char* name) {
    const VtValue id = params.delegate->GetLightParamValue(params.id, TfToken(name));
    return id.IsHolding<TfToken>() ? id.UncheckedGet<TfToken>().GetString() : std::string();
}

std::string readLightGroup(LightParams const& params) {
    for (const char* name : {"hipr:lightGroup", "karma:light:lpetag", "ri:light:lightGroup"}) {
        const VtValue value = lightParam(params.delegate, params.id, TfToken(name));
        const std::string group = value.IsHolding<TfToken>() ? value.UncheckedGet<TfToken>().GetString()
                                                             : value.GetWithDefault<std::string>();
        if (!group.empty()) {
            return group;
        }
    }
    return {};
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
