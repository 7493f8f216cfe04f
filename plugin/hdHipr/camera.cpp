#include "plugin/hdHipr/camera.h"

#include <algorithm>
#include <cmath>

#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/motion.h"
#include "plugin/hdHipr/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

/// Camera parameters as numbers.
class Params {
public:
    Params(HdSceneDelegate* delegate, SdfPath const& id) : _delegate(delegate), _id(id) {}

    /// `fallback` where the parameter is not authored, no number, or not finite.
    double get(char const* name, double fallback) const {
        const VtValue value = VtValue::Cast<double>(_delegate->GetCameraParamValue(_id, TfToken(name)));
        const double number = value.IsHolding<double>() ? value.UncheckedGet<double>() : fallback;
        return std::isfinite(number) ? number : fallback;
    }
    /// A parameter that Hydra calls by another name than USD; old versions only know the latter.
    double get(char const* hydraName, char const* usdName, double fallback) const {
        return get(hydraName, get(usdName, fallback));
    }
    bool off(char const* name) const {
        const VtValue value = _delegate->GetCameraParamValue(_id, TfToken(name));
        return value.IsHolding<bool>() && !value.UncheckedGet<bool>();
    }

private:
    HdSceneDelegate* _delegate;
    SdfPath const& _id;
};

hipr::Lens lensOf(Params const& params, SdfPath const& id) {
    hipr::Lens lens;
    const double fStop = params.get("fStop", 0.0);
    if (fStop <= 0.0 || params.off("focusOn")) {
        return lens;
    }
    lens.focusDistance = params.get("focusDistance", 0.0);
    if (lens.focusDistance <= 0.0) {
        hdhipr::warnOnce(id.GetString(), "fStop is authored, but no focusDistance: everything is sharp");
        return {};
    }
    lens.radius = params.get("focalLength", 0.0) / (2.0 * fStop);
    lens.blades = int(std::clamp(params.get("hipr:apertureBlades", 0.0), 0.0, 1024.0));
    lens.bladeRotation = float(params.get("hipr:apertureRotation", 0.0));
    return lens;
}

float exposureOf(Params const& params, SdfPath const& id) {
    const double fStop = params.get("exposureFStop", "exposure:fStop", 1.0);
    const double scale = params.get("exposureTime", "exposure:time", 1.0) *
                         params.get("exposureIso", "exposure:iso", 100.0) / 100.0 *
                         std::exp2(params.get("exposure", 0.0)) *
                         params.get("exposureResponsivity", "exposure:responsivity", 1.0) / (fStop * fStop);
    if (std::isfinite(float(scale)) && scale >= 0.0) {
        return float(scale);
    }
    hdhipr::warnOnce(id.GetString(), "the exposure parameters do not make a number; the exposure is 1");
    return 1.f;
}

} // namespace

void HdHiprCamera::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) {
    if (*dirtyBits & DirtyParams) {
        const Params params(delegate, GetId());
        _lens = lensOf(params, GetId());
        _exposure = exposureOf(params, GetId());
        _shutter = {params.get("shutterOpen", 0.0), params.get("shutterClose", 0.0)};
        if (static_cast<HdHiprRenderParam*>(renderParam)->setShutter(GetId(), _shutter)) {
            delegate->GetRenderIndex().GetChangeTracker().MarkAllRprimsDirty(hdhipr::sampledBits);
        }
    }
    _motion.clear();
    const hdhipr::Samples<GfMatrix4d> samples =
        _shutter.blurs() ? hdhipr::sampleTransform(*delegate, GetId()) : hdhipr::Samples<GfMatrix4d>();
    for (size_t i = 0; i < samples.times.size() && samples.moves(); ++i) {
        _motion.push_back({samples.times[i], hdhipr::toGlm(samples.values[i].GetInverse())});
    }
    HdCamera::Sync(delegate, renderParam, dirtyBits);
}

void HdHiprCamera::Finalize(HdRenderParam* renderParam) {
    static_cast<HdHiprRenderParam*>(renderParam)->dropShutter(GetId());
    HdCamera::Finalize(renderParam);
}

PXR_NAMESPACE_CLOSE_SCOPE
