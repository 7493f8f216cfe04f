/// @file particleField.h
/// HdHiprParticleField: one cloud of Gaussian splats and all its instances.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "renderer/api/scene.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderParam;

/// The Rprim that UsdVol's ParticleField3DGaussianSplat becomes. A moved or hidden cloud sends transforms or
/// visibility; changed values send the cloud again, which the renderer compares with the one it has.
class HdHiprParticleField final : public hdhipr::RprimBase<HdRprim> {
public:
    HdHiprParticleField(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param);

    HdDirtyBits GetInitialDirtyBitsMask() const override;
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
              TfToken const& reprToken) override;
    void Finalize(HdRenderParam* renderParam) override;
    TfTokenVector const& GetBuiltinPrimvarNames() const override;

protected:
    void _InitRepr(TfToken const& reprToken, HdDirtyBits* dirtyBits) override;
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override;
    void renderTagChanged(HdSceneDelegate* delegate, HdRenderParam* renderParam) override;

private:
    void sendObject(HdSceneDelegate* delegate, HdHiprRenderParam& param);

    hipr::SplatsId _splats;
    hipr::ObjectId _object;
    bool _synced = false;
};

PXR_NAMESPACE_CLOSE_SCOPE
