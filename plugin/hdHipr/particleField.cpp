#include "plugin/hdHipr/particleField.h"

#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/renderParam.h"
#include "plugin/hdHipr/splatCloud.h"
#include "plugin/hdHipr/unsupported.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

constexpr HdDirtyBits objectBits =
    HdChangeTracker::DirtyVisibility | HdChangeTracker::DirtyPrimID | HdChangeTracker::DirtyRenderTag;
constexpr HdDirtyBits instanceBits =
    HdChangeTracker::DirtyTransform | HdChangeTracker::DirtyInstancer | HdChangeTracker::DirtyInstanceIndex;
/// Hosts have no bit for any one array of a cloud.
constexpr HdDirtyBits valueBits = HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyPoints;

} // namespace

HdHiprParticleField::HdHiprParticleField(SdfPath const& id, SdfPath const& instancerId,
                                         HdHiprRenderParam& param)
    : RprimBase(id, instancerId), _splats(param.newId<hipr::SplatsId>()),
      _object(param.newId<hipr::ObjectId>()) {}

HdDirtyBits HdHiprParticleField::GetInitialDirtyBitsMask() const {
    return HdChangeTracker::InitRepr | objectBits | instanceBits | HdChangeTracker::DirtyPrimvar;
}

TfTokenVector const& HdHiprParticleField::GetBuiltinPrimvarNames() const {
    return splatPrimvarNames();
}

/// There is one way to draw splats.
void HdHiprParticleField::_InitRepr(TfToken const&, HdDirtyBits*) {}

HdDirtyBits HdHiprParticleField::_PropagateDirtyBits(HdDirtyBits bits) const {
    // So that the host prepares all of them.
    return bits & HdChangeTracker::DirtyPoints ? bits | HdChangeTracker::DirtyPrimvar : bits;
}

void HdHiprParticleField::Finalize(HdRenderParam* renderParam) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    param.removeObject(_object);
    param.edit().removeSplats(_splats);
    HdRprim::Finalize(renderParam);
}

void HdHiprParticleField::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
                               TfToken const&) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    syncInstancer(delegate, dirtyBits);
    const HdDirtyBits bits = *dirtyBits;
    if (bits & HdChangeTracker::DirtyVisibility) {
        _UpdateVisibility(delegate, dirtyBits);
    }
    if (bits & valueBits) {
        param.edit().setSplats(_splats, readSplatCloud(*delegate, GetId()));
    }
    if (bits & objectBits) {
        sendObject(delegate, param);
    }
    // Last: UsdImaging hands out values once, and asking for samples of them counts.
    if (bits & (instanceBits | valueBits)) {
        const Sampling sampling = param.sampling();
        if (bits & instanceBits) {
            param.edit().setInstances(_object, readInstances(*delegate, GetId(), GetInstancerId(), sampling));
        }
        if (sampling.open()) {
            warnOfMotion(*delegate, GetId(), SplatTokens().positions);
        }
    }
    *dirtyBits = HdChangeTracker::Clean;
}

void HdHiprParticleField::sendObject(HdSceneDelegate* delegate, HdHiprRenderParam& param) {
    ObjectState state;
    state.path = GetId();
    state.renderTag = delegate->GetRenderTag(GetId());
    state.desc.name = GetId().GetString();
    state.desc.splats = _splats;
    state.desc.visible = IsVisible();
    state.desc.primId = GetPrimId();
    param.setObject(_object, state);
    _synced = true;
}

void HdHiprParticleField::renderTagChanged(HdSceneDelegate* delegate, HdRenderParam* renderParam) {
    if (_synced) {
        sendObject(delegate, static_cast<HdHiprRenderParam&>(*renderParam));
    }
}

PXR_NAMESPACE_CLOSE_SCOPE
