/// @file dirty_bits_rows.h
/// Short forms in which the rows of dirty_bits.h are written.
#pragma once

#include <utility>

#include "testenv/unit/delegate/dirty_bits.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace dirtybits {

using Bits = HdChangeTracker;
using hipr::Change;
using Apply = std::function<void(World&, bool make)>;
using Edit = std::function<void(TestScene::Prim&, bool make)>;

inline void noEdit(TestScene::Prim&, bool) {}

/// Edits a prim and marks bits of it.
inline Apply rprim(const char* path, HdDirtyBits bits, Edit edit = noEdit) {
    return [=](World& world, bool make) {
        edit(world.prim(path), make);
        world.tracker().MarkRprimDirty(SdfPath(path), bits);
    };
}
inline Apply instancer(const char* path, HdDirtyBits bits, Edit edit = noEdit) {
    return [=](World& world, bool make) {
        edit(world.prim(path), make);
        world.tracker().MarkInstancerDirty(SdfPath(path), bits);
    };
}
inline Apply sprim(const char* path, HdDirtyBits bits, Edit edit = noEdit) {
    return [=](World& world, bool make) {
        edit(world.prim(path), make);
        world.tracker().MarkSprimDirty(SdfPath(path), bits);
    };
}

/// Gives a prim another id.
inline Apply setPrimId(const char* path, int id) {
    return [=](World& world, bool make) {
        HdRprim const* rprim = world.host().index().GetRprim(SdfPath(path));
        const_cast<HdRprim*>(rprim)->SetPrimId(make ? id : 0);
        world.tracker().MarkRprimDirty(SdfPath(path), Bits::DirtyPrimID);
    };
}

/// A bit of a prim that means nothing.
inline Row nothing(const char* path, const char* bit, HdDirtyBits bits, const char* why) {
    return {bit, why, "", rprim(path, bits), {}};
}

/// An edit that moves a prim.
inline void move(TestScene::Prim& prim, bool make) {
    const GfVec3d before = prim.transform.ExtractTranslation();
    prim.transform.SetTranslate(GfVec3d(before[0], before[1], make ? 0.5 : 0.0));
}

/// An edit of one of a prim's parameters.
template <class T> Edit param(const char* name, T made, T undone) {
    return
        [=](TestScene::Prim& prim, bool make) { prim.params[TfToken(name)] = VtValue(make ? made : undone); };
}

/// An edit of the values of one of a prim's primvars.
template <class T> Edit values(const char* name, T made, T undone) {
    return [=](TestScene::Prim& prim, bool make) {
        prim.primvars.at(TfToken(name)).value = VtValue(make ? made : undone);
    };
}

/// The collections of lights that something is in.
inline VtArray<TfToken> categories(bool some) {
    return some ? VtArray<TfToken>{TfToken("some")} : VtArray<TfToken>();
}

/// The same change of several instances of one object.
inline Elements instances(Target target, Change change, std::initializer_list<uint32_t> which) {
    Elements elements;
    for (uint32_t instance : which) {
        elements.push_back({target, change, instance});
    }
    return elements;
}

} // namespace dirtybits

PXR_NAMESPACE_CLOSE_SCOPE
