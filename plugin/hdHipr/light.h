/// @file light.h
/// HdHiprLight: the six UsdLux lights.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "renderer/api/light.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderParam;

class HdHiprLight final : public hdhipr::LightBase {
public:
    static bool handles(TfToken const& type);

    HdHiprLight(SdfPath const& id, TfToken const& type);

    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;

private:
    void syncParams(HdSceneDelegate* delegate);
    void syncLinks(HdSceneDelegate* delegate, HdDirtyBits bits);
    void reportUnsupported(HdSceneDelegate* delegate) const;
    void send(HdSceneDelegate* delegate, HdHiprRenderParam& param);
    bool isCameraLight(HdSceneDelegate* delegate) const;
    std::vector<GfMatrix4d> instanceTransforms(HdSceneDelegate* delegate) const;

    GfMatrix4d _transform{1.0};
    hipr::LightDesc _desc;
    bool _cameraLight = false;          ///< of a viewer
    std::vector<hipr::LightId> _lights; ///< one for each instance
};

PXR_NAMESPACE_CLOSE_SCOPE
