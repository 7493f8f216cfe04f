/// @file particleField.h
/// HdHiprParticleField: one cloud of Gaussian splats and all its instances.
#pragma once

#include "plugin/hdHipr/objectPrim.h"
#include "renderer/api/scene.h"

PXR_NAMESPACE_OPEN_SCOPE

/// The Rprim that UsdVol's ParticleField3DGaussianSplat becomes. A moved or hidden cloud sends transforms or
/// visibility; changed values send the cloud again, which the renderer compares with the one it has.
class HdHiprParticleField final : public hdhipr::ObjectPrim<HdRprim> {
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
    void describe(HdSceneDelegate& delegate, HdHiprRenderParam& param, hipr::ObjectDesc& desc) override;

private:
    hipr::SplatsId _splats;
};

PXR_NAMESPACE_CLOSE_SCOPE
