#include "plugin/hdHipr/camera.h"

#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

void HdHiprCamera::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) {
    const auto param = [&](const char* name) {
        const VtValue value = VtValue::Cast<double>(delegate->GetCameraParamValue(GetId(), TfToken(name)));
        return value.IsHolding<double>() ? value.UncheckedGet<double>() : 0.0;
    };
    if (*dirtyBits & DirtyParams) {
        if (param("fStop") > 0.0) {
            hdhipr::warnOnce(GetId().GetString(),
                             "depth of field (fStop) is not supported; the camera is a pinhole");
        }
        if (param("exposure") != 0.0) {
            hdhipr::warnOnce(GetId().GetString(), "camera exposure is not supported and has no effect");
        }
        static_cast<HdHiprRenderParam*>(renderParam)
            ->setShutter(GetId(), param("shutterClose") > param("shutterOpen"));
    }
    HdCamera::Sync(delegate, renderParam, dirtyBits);
}

void HdHiprCamera::Finalize(HdRenderParam* renderParam) {
    static_cast<HdHiprRenderParam*>(renderParam)->setShutter(GetId(), false);
    HdCamera::Finalize(renderParam);
}

PXR_NAMESPACE_CLOSE_SCOPE
