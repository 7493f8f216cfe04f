/// @file camera.h
/// HdHiprCamera: a scene camera. View, projection, apertures and clipping range reach the renderer as the
/// matrices of the render pass state, which also applies the window policy.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "pxr/imaging/hd/camera.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprCamera final : public HdCamera {
public:
    explicit HdHiprCamera(SdfPath const& id) : HdCamera(id) {}

    /// All parameters: HdCamera leaves out those that it does not read itself.
    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }

    /// Tells which authored parameters have no effect.
    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;
};

PXR_NAMESPACE_CLOSE_SCOPE
