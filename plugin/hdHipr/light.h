/// @file light.h
/// HdHiprLight: the six UsdLux lights.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "renderer/api/light.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprLight final : public HdLight {
public:
    static bool handles(TfToken const& type);

    HdHiprLight(SdfPath const& id, TfToken const& type);

    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;

private:
    void syncParams(HdSceneDelegate* delegate);
    void reportUnsupported(HdSceneDelegate* delegate) const;

    hipr::LightId _light = hipr::LightId::None;
    hipr::LightDesc _desc;
};

PXR_NAMESPACE_CLOSE_SCOPE
