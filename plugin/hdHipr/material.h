/// @file material.h
/// HdHiprMaterial: a material network as the renderer's description.
#pragma once

#include "plugin/hdHipr/compat.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprMaterial final : public hdhipr::MaterialBase {
public:
    using MaterialBase::MaterialBase;

    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;
};

PXR_NAMESPACE_CLOSE_SCOPE
