#include "plugin/hdHipr/camera.h"

#include "plugin/hdHipr/messages.h"

PXR_NAMESPACE_OPEN_SCOPE

void HdHiprCamera::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) {
    if (*dirtyBits & DirtyParams) {
        const VtValue fStop =
            VtValue::Cast<double>(delegate->GetCameraParamValue(GetId(), HdCameraTokens->fStop));
        if (fStop.IsHolding<double>() && fStop.UncheckedGet<double>() > 0.0) {
            hdhipr::warnOnce(GetId().GetString(),
                             "depth of field (fStop) is not supported; the camera is a pinhole");
        }
    }
    HdCamera::Sync(delegate, renderParam, dirtyBits);
}

PXR_NAMESPACE_CLOSE_SCOPE
