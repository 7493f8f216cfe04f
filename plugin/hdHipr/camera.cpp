#include "plugin/hdHipr/camera.h"

#include "plugin/hdHipr/messages.h"

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
    }
    HdCamera::Sync(delegate, renderParam, dirtyBits);
}

PXR_NAMESPACE_CLOSE_SCOPE
