/// @file volume.h
/// HdHiprVolume: one volume and all its instances.
#pragma once

#include "plugin/hdHipr/objectPrim.h"
#include "pxr/imaging/hd/volume.h"
#include "renderer/api/scene.h"

PXR_NAMESPACE_OPEN_SCOPE

/// UsdVol's Volume. Its fields are prims of their own (HdHiprField), which it names by what they are for; its
/// look comes from its material's volume terminal or else from primvars `hipr:volume:*` (docs/volumes.md).
class HdHiprVolume final : public hdhipr::ObjectPrim<HdVolume> {
public:
    HdHiprVolume(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param);

    HdDirtyBits GetInitialDirtyBitsMask() const override;
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
              TfToken const& reprToken) override;
    void Finalize(HdRenderParam* renderParam) override;

protected:
    void _InitRepr(TfToken const& reprToken, HdDirtyBits* dirtyBits) override;
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override;
    void describe(HdSceneDelegate& delegate, HdHiprRenderParam& param, hipr::ObjectDesc& desc) override;

private:
    void readFields(HdSceneDelegate* delegate, HdHiprRenderParam& param);
    void readLook(HdSceneDelegate* delegate);

    hipr::VolumeId _volume;
    hipr::VolumeDesc _desc;
};

PXR_NAMESPACE_CLOSE_SCOPE
