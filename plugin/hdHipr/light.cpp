#include "plugin/hdHipr/light.h"

#include <optional>
#include <unordered_map>

#include "plugin/hdHipr/assets.h"
#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/lightParams.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/renderParam.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

std::optional<hipr::LightKind> lightKind(TfToken const& type) {
    static const std::unordered_map<TfToken, hipr::LightKind, TfToken::HashFunctor> kinds = {
        {HdPrimTypeTokens->domeLight, hipr::LightKind::Dome},
        {HdPrimTypeTokens->distantLight, hipr::LightKind::Distant},
        {HdPrimTypeTokens->rectLight, hipr::LightKind::Rect},
        {HdPrimTypeTokens->sphereLight, hipr::LightKind::Sphere},
        {HdPrimTypeTokens->diskLight, hipr::LightKind::Disk},
        {HdPrimTypeTokens->cylinderLight, hipr::LightKind::Cylinder},
    };
    const auto found = kinds.find(type);
    return found == kinds.end() ? std::nullopt : std::optional(found->second);
}

hipr::DomeFormat domeFormat(SdfPath const& id, TfToken const& format) {
    if (format == "mirroredBall") {
        return hipr::DomeFormat::MirroredBall;
    }
    if (format == "angular") {
        return hipr::DomeFormat::Angular;
    }
    if (format == "cubeMapVerticalCross") {
        return hipr::DomeFormat::CubeMapVerticalCross;
    }
    if (format != "automatic" && format != "latlong") {
        warnOnce(id.GetString(), "texture:format '" + format.GetString() + "' is unknown; taken as latlong");
    }
    return hipr::DomeFormat::LatLong;
}

} // namespace

bool HdHiprLight::handles(TfToken const& type) {
    return lightKind(type).has_value();
}

HdHiprLight::HdHiprLight(SdfPath const& id, TfToken const& type) : LightBase(id) {
    _desc.name = id.GetString();
    _desc.kind = lightKind(type).value_or(hipr::LightKind::Sphere);
}

void HdHiprLight::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    syncInstancer(delegate, dirtyBits);
    if (*dirtyBits & (DirtyTransform | DirtyParams)) {
        _transform = lightTransform(delegate, GetId());
        if (_desc.kind == hipr::LightKind::Dome) {
            _transform = domeOffset(delegate, GetId()) * _transform;
        }
    }
    if (*dirtyBits & (DirtyParams | DirtyShadowParams | DirtyCollection)) {
        _cameraLight = isCameraLight(delegate);
        syncParams(delegate);
        syncLinks(delegate, *dirtyBits);
        reportUnsupported(delegate);
    }
    send(delegate, param);
    *dirtyBits = Clean;
}

void HdHiprLight::send(HdSceneDelegate* delegate, HdHiprRenderParam& param) {
    const std::vector<GfMatrix4d> transforms = instanceTransforms(delegate);
    while (_lights.size() > transforms.size()) {
        param.removeLight(_lights.back());
        _lights.pop_back();
    }
    while (_lights.size() < transforms.size()) {
        _lights.push_back(param.newId<hipr::LightId>());
    }
    for (size_t i = 0; i < transforms.size(); ++i) {
        _desc.transform = toGlm(transforms[i]);
        param.setLight(_lights[i], _desc);
    }
}

/// The light that a viewer puts at its camera is there for scenes without lights. OpenUSD newer than 20.08
/// hands it to renderers other than Storm as a light of a fixed size and intensity, which fits few scenes,
/// and tells what it was made from: a GlfSimpleLight. The renderer's own camera light stands in.
bool HdHiprLight::isCameraLight(HdSceneDelegate* delegate) const {
    return _desc.kind != hipr::LightKind::Dome &&
           TfStringEndsWith(delegate->GetLightParamValue(GetId(), HdLightTokens->params).GetTypeName(),
                            "GlfSimpleLight");
}

std::vector<GfMatrix4d> HdHiprLight::instanceTransforms(HdSceneDelegate* delegate) const {
    if (_cameraLight) {
        return {};
    }
    if (instancerId().IsEmpty()) {
        return {_transform};
    }
    HdInstancer* instancer = delegate->GetRenderIndex().GetInstancer(instancerId());
    if (!instancer) {
        warnOnce(GetId().GetString(),
                 "its instancer <" + instancerId().GetString() + "> does not exist; the light is off");
        return {};
    }
    std::vector<GfMatrix4d> transforms =
        static_cast<HdHiprInstancer*>(instancer)->instances(GetId()).transforms;
    for (GfMatrix4d& transform : transforms) {
        transform = _transform * transform;
    }
    return transforms;
}

void HdHiprLight::syncParams(HdSceneDelegate* delegate) {
    const LightParams params{delegate, GetId()};
    _desc.visible = lightVisible(delegate, GetId());
    _desc.intensity = params.get("intensity", 1.f);
    _desc.exposure = params.get("exposure", 0.f);
    _desc.color = toGlm(params.get("color", GfVec3f(1.f)));
    _desc.enableColorTemperature = params.get("enableColorTemperature", false);
    _desc.colorTemperature = params.get("colorTemperature", 6500.f);
    _desc.normalize = params.get("normalize", false);
    _desc.diffuse = params.get("diffuse", 1.f);
    _desc.specular = params.get("specular", 1.f);
    _desc.radius = params.get("radius", 0.5f);
    _desc.width = params.get("width", 1.f);
    _desc.height = params.get("height", 1.f);
    _desc.length = params.get("length", 1.f);
    _desc.angle = params.get("angle", 0.53f);
    _desc.texture.clear();
    if (_desc.kind == hipr::LightKind::Dome || _desc.kind == hipr::LightKind::Rect) {
        _desc.texture = assetPath(lightParam(delegate, GetId(), TfToken("texture:file")));
    }
    _desc.domeFormat = domeFormat(GetId(), params.get("texture:format", TfToken("automatic")));
    _desc.thin = (_desc.kind == hipr::LightKind::Sphere && params.get("treatAsPoint", false)) ||
                 (_desc.kind == hipr::LightKind::Cylinder && params.get("treatAsLine", false));
    _desc.shaping = readShaping(params);
    _desc.shadow = readShadow(params);
    _desc.group = readLightGroup(params);
}

void HdHiprLight::syncLinks(HdSceneDelegate* delegate, HdDirtyBits bits) {
    const LightParams params{delegate, GetId()};
    _desc.lightLink = readLink(params, "lightLink");
    _desc.shadowLink = readLink(params, "shadowLink");
    if ((bits & DirtyCollection) && !(_desc.lightLink.empty() && _desc.shadowLink.empty())) {
        collectionsChanged(delegate->GetRenderIndex());
    }
}

void HdHiprLight::reportUnsupported(HdSceneDelegate* delegate) const {
    const auto ignored = [&](const char* what) {
        warnOnce(GetId().GetString(), std::string(what) + " is not supported and has no effect");
    };
    if (_desc.kind == hipr::LightKind::Dome && !_desc.shaping.iesFile.empty()) {
        ignored("an IES profile on a dome light (shaping:ies:file)");
    }
    const VtValue portals = delegate->GetLightParamValue(GetId(), TfToken("portals"));
    if (portals.IsHolding<SdfPathVector>() && !portals.UncheckedGet<SdfPathVector>().empty()) {
        ignored("sampling through portals");
    }
}

void HdHiprLight::Finalize(HdRenderParam* renderParam) {
    for (hipr::LightId light : _lights) {
        static_cast<HdHiprRenderParam*>(renderParam)->removeLight(light);
    }
    _lights.clear();
}

PXR_NAMESPACE_CLOSE_SCOPE
