/// @file renderSettingsPrim.h
/// HdHiprRenderSettings: a stage's RenderSettings prim, for hosts that hand it over (OpenUSD 23.11 and
/// newer).
#pragma once

#include "plugin/hdHipr/compat.h"
#if PXR_VERSION >= 2311
#include "pxr/imaging/hd/renderSettings.h"

PXR_NAMESPACE_OPEN_SCOPE

/// While it is the one that the host has made active, its `hipr:` attributes are render settings of the
/// delegate. What its first product says of motion blur and depth of field is so, too, as one delegate
/// renders one picture. Size, camera and products are the host's to follow.
class HdHiprRenderSettings final : public HdRenderSettings {
public:
    explicit HdHiprRenderSettings(SdfPath const& id) : HdRenderSettings(id) {}

private:
    void _Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, const HdDirtyBits* dirtyBits) override;
};

PXR_NAMESPACE_CLOSE_SCOPE
#endif
