/// @file volume.h
/// HdHiprVolume: one volume and all its instances.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "plugin/hdHipr/instancer.h"
#include "pxr/imaging/hd/volume.h"
#include "renderer/api/scene.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderParam;

/// UsdVol's Volume. Its fields are prims of their own (HdHiprField), which it names by what they are for; its
/// look comes from its material's volume terminal or else from primvars `hipr:volume:*` (docs/volumes.md).
class HdHiprVolume final : public hdhipr::RprimBase<HdVolume> {
public:
    HdHiprVolume(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param);

    HdDirtyBits GetInitialDirtyBitsMask() const override;
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
              TfToken const& reprToken) override;
    void Finalize(HdRenderParam* renderParam) override;

protected:
    void _InitRepr(TfToken const& reprToken, HdDirtyBits* dirtyBits) override;
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override;
    void renderTagChanged(HdSceneDelegate* delegate, HdRenderParam* renderParam) override;

private:
    void readFields(HdSceneDelegate* delegate, HdHiprRenderParam& param);
    void readLook(HdSceneDelegate* delegate);
    void sendObject(HdSceneDelegate* delegate, HdHiprRenderParam& param);

    hipr::VolumeId _volume;
    hipr::ObjectId _object;
    hipr::VolumeDesc _desc;
    hdhipr::LinkState _links;
    bool _synced = false;
};

PXR_NAMESPACE_CLOSE_SCOPE
