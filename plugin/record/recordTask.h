/// @file recordTask.h
/// The one Hydra task of a recording: a render pass through a camera into AOV buffers.
#pragma once

#include <optional>

#include "plugin/record/dataWindow.h"
#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/vec2i.h"
#include "pxr/imaging/hd/aov.h"
#include "pxr/imaging/hd/renderPass.h"
#include "pxr/imaging/hd/renderPassState.h"
#include "pxr/imaging/hd/task.h"

namespace hipr::record {

/// Whether Hydra itself knows data windows and pixel aspects. Before, it is a matter of HiPR's own.
constexpr bool HydraHasFraming = PXR_VERSION >= 2308;

/// How the camera's picture lies on the pixels of the AOV buffers.
struct PictureFraming {
    PXR_NS::GfVec2i size{0, 0}; ///< pixels of the camera's picture
    std::optional<float>
        pixelAspect;   ///< width over height of a pixel; none: what the camera's aperture makes it
    DataWindow window; ///< those of its pixels that the buffers hold
    /// Whether every renderer of every Hydra can do it.
    bool isPlain() const { return window.isAllOf(size[0], size[1]) && pixelAspect.value_or(1.f) == 1.f; }
};

class RecordTask final : public PXR_NS::HdTask {
public:
    /// Before OpenUSD 23.08 only HiPR knows data windows and pixels that are not square, by a setting; other
    /// renderers show the picture that fits the buffers.
    RecordTask(PXR_NS::HdRenderIndex* index, const PXR_NS::SdfPath& camera, const PictureFraming& framing,
               const PXR_NS::HdRenderPassAovBindingVector& bindings, const PXR_NS::TfTokenVector& renderTags);

    void Sync(PXR_NS::HdSceneDelegate*, PXR_NS::HdTaskContext*, PXR_NS::HdDirtyBits* dirtyBits) override;
    void Prepare(PXR_NS::HdTaskContext*, PXR_NS::HdRenderIndex* index) override;
    void Execute(PXR_NS::HdTaskContext*) override;
    const PXR_NS::TfTokenVector& GetRenderTags() const override { return _renderTags; }

    void setCamera(const PXR_NS::SdfPath& camera) { _camera = camera; }
    bool isConverged() const { return _pass->IsConverged(); }
    /// Matrices of the last execution, the projection that of the whole picture.
    PXR_NS::GfMatrix4d worldToView() const { return _state->GetWorldToViewMatrix(); }
    PXR_NS::GfMatrix4d projection() const;
    /// Width over height of a pixel.
    float pixelAspect() const;

private:
    PXR_NS::GfVec4f windowNdc() const;

    PXR_NS::SdfPath _camera;
    PictureFraming _framing;
    PXR_NS::TfTokenVector _renderTags;
    PXR_NS::HdRenderPassSharedPtr _pass;
    PXR_NS::HdRenderPassStateSharedPtr _state;
};

} // namespace hipr::record
