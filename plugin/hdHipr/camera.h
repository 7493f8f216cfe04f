/// @file camera.h
/// HdHiprCamera: a scene camera. View, projection, apertures and clipping range reach the renderer as the
/// matrices of the render pass state, which also applies the window policy; lens,
/// exposure, shutter and motion come from here.
#pragma once

#include "plugin/hdHipr/compat.h"
#include "pxr/imaging/hd/camera.h"
#include "renderer/api/camera.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprCamera final : public HdCamera {
public:
    explicit HdHiprCamera(SdfPath const& id) : HdCamera(id) {}

    /// All parameters: HdCamera leaves out those that it does not read itself.
    HdDirtyBits GetInitialDirtyBitsMask() const override { return AllDirty; }

    void Sync(HdSceneDelegate* delegate, HdRenderParam* renderParam, HdDirtyBits* dirtyBits) override;
    void Finalize(HdRenderParam* renderParam) override;

    /// From fStop, focalLength, focusDistance, focusOn, `hipr:apertureBlades` and `hipr:apertureRotation`.
    hipr::Lens const& lens() const { return _lens; }

    /// The factor that exposure, iso, time, fStop and responsivity of the exposure make together
    /// (UsdGeomCamera::ComputeLinearExposureScale).
    float exposure() const { return _exposure; }

    /// From shutterOpen and shutterClose, in frames.
    hipr::Shutter const& shutter() const { return _shutter; }
    /// Where the camera is while the shutter is open; empty when it stands still.
    std::vector<hipr::CameraKey> const& motion() const { return _motion; }

private:
    hipr::Lens _lens;
    hipr::Shutter _shutter;
    std::vector<hipr::CameraKey> _motion;
    float _exposure = 1.f;
};

PXR_NAMESPACE_CLOSE_SCOPE
