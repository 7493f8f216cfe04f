/// @file objectPrim.h
/// What all drawn prims have in common: each is one object, which stands somewhere.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/renderParam.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// An Rprim with one object. Says what that is as far as all prims say it alike; describe() adds the rest.
template <class Base> class ObjectPrim : public RprimBase<Base> {
protected:
    ObjectPrim(SdfPath const& id, SdfPath const& instancerId, HdHiprRenderParam& param)
        : RprimBase<Base>(id, instancerId), _object(param.newId<hipr::ObjectId>()) {}

    /// What changes the object, and what moves it.
    static constexpr HdDirtyBits objectBits =
        HdChangeTracker::DirtyVisibility | HdChangeTracker::DirtyMaterialId | HdChangeTracker::DirtyPrimID |
        HdChangeTracker::DirtyRenderTag | HdChangeTracker::DirtyCategories;
    static constexpr HdDirtyBits instanceBits = HdChangeTracker::DirtyTransform |
                                                HdChangeTracker::DirtyInstancer |
                                                HdChangeTracker::DirtyInstanceIndex;

    /// Adds what the object shows: its geometry, splats or volume, and its materials.
    virtual void describe(HdSceneDelegate& delegate, HdHiprRenderParam& param, hipr::ObjectDesc& desc) = 0;

    /// The beginning of every Sync: what Hydra itself keeps of a prim. Returns what there is to sync.
    HdDirtyBits syncBase(HdSceneDelegate* delegate, HdDirtyBits* dirtyBits) {
        this->syncInstancer(delegate, dirtyBits);
        const HdDirtyBits bits = *dirtyBits;
        if (bits & HdChangeTracker::DirtyVisibility) {
            this->_UpdateVisibility(delegate, dirtyBits);
        }
        if (bits & HdChangeTracker::DirtyMaterialId) {
            this->updateMaterialId(delegate, delegate->GetMaterialId(this->GetId()));
        }
        return bits;
    }
    /// Reads what lights may be linked to the prim by. Returns whether its instances have to be sent for it.
    bool syncLinks(HdSceneDelegate& delegate, HdDirtyBits bits) {
        return _links.sync(delegate, this->GetId(), this->GetInstancerId(), bits);
    }

    void sendObject(HdSceneDelegate& delegate, HdHiprRenderParam& param) {
        ObjectState state;
        state.path = this->GetId();
        state.renderTag = delegate.GetRenderTag(this->GetId());
        state.desc.name = this->GetId().GetString();
        state.desc.visible = this->IsVisible();
        state.desc.primId = this->GetPrimId();
        state.desc.categories = _links.names();
        describe(delegate, param, state.desc);
        param.setObject(_object, state);
        _sent = true;
    }
    void sendInstances(hipr::InstancesDesc desc, HdHiprRenderParam& param) {
        param.edit().setInstances(_object, std::move(desc));
    }
    /// Where the prim stands; with an open shutter also at other times.
    hipr::InstancesDesc standingAt(HdSceneDelegate& delegate, Sampling const& sampling) const {
        return readInstances(delegate, this->GetId(), this->GetInstancerId(), sampling);
    }
    void removeObject(HdHiprRenderParam& param) { param.removeObject(_object); }

    void renderTagChanged(HdSceneDelegate* delegate, HdRenderParam* renderParam) final {
        if (_sent) {
            sendObject(*delegate, static_cast<HdHiprRenderParam&>(*renderParam));
        }
    }

private:
    hipr::ObjectId _object;
    LinkState _links;
    bool _sent = false;
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
