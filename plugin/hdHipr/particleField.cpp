#include "plugin/hdHipr/particleField.h"

#include "plugin/hdHipr/splatCloud.h"
#include "plugin/hdHipr/unsupported.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

/// Splats have no material, and no light shines on them.
constexpr HdDirtyBits cloudBits =
    HdChangeTracker::DirtyVisibility | HdChangeTracker::DirtyPrimID | HdChangeTracker::DirtyRenderTag;
/// Hosts have no bit for any one array of a cloud.
constexpr HdDirtyBits valueBits = HdChangeTracker::DirtyPrimvar | HdChangeTracker::DirtyPoints;

} // namespace

HdHiprParticleField::HdHiprParticleField(SdfPath const& id, SdfPath const& instancerId,
                                         HdHiprRenderParam& param)
    : ObjectPrim(id, instancerId, param), _splats(param.newId<hipr::SplatsId>()) {}

HdDirtyBits HdHiprParticleField::GetInitialDirtyBitsMask() const {
    return HdChangeTracker::InitRepr | cloudBits | instanceBits | HdChangeTracker::DirtyPrimvar;
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
    removeObject(param);
    param.edit().removeSplats(_splats);
    HdRprim::Finalize(renderParam);
}

void HdHiprParticleField::Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits,
                               TfToken const&) {
    auto& param = static_cast<HdHiprRenderParam&>(*renderParam);
    const HdDirtyBits bits = syncBase(delegate, dirtyBits);
    if (bits & valueBits) {
        param.edit().setSplats(_splats, readSplatCloud(*delegate, GetId()));
    }
    if (bits & cloudBits) {
        sendObject(*delegate, param);
    }
    // Last: UsdImaging hands out values once, and asking for samples of them counts.
    if (bits & (instanceBits | valueBits)) {
        const Sampling sampling = param.sampling();
        if (bits & instanceBits) {
            sendInstances(standingAt(*delegate, sampling), param);
        }
        if (sampling.open()) {
            warnOfMotion(*delegate, GetId(), SplatTokens().positions);
        }
    }
    *dirtyBits = HdChangeTracker::Clean;
}

void HdHiprParticleField::describe(HdSceneDelegate&, HdHiprRenderParam&, hipr::ObjectDesc& desc) {
    desc.splats = _splats;
}

PXR_NAMESPACE_CLOSE_SCOPE
