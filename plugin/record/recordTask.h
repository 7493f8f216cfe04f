/// @file recordTask.h
/// The one Hydra task of a recording: a render pass through a camera into AOV buffers.
#pragma once

#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/gf/vec2i.h"
#include "pxr/imaging/hd/aov.h"
#include "pxr/imaging/hd/renderPass.h"
#include "pxr/imaging/hd/renderPassState.h"
#include "pxr/imaging/hd/task.h"

namespace hipr::record {

class RecordTask final : public PXR_NS::HdTask {
public:
    /// `size` is the width and height of all AOV buffers in pixels.
    RecordTask(PXR_NS::HdRenderIndex* index, const PXR_NS::SdfPath& camera, const PXR_NS::GfVec2i& size,
               const PXR_NS::HdRenderPassAovBindingVector& bindings, const PXR_NS::TfTokenVector& renderTags);

    void Sync(PXR_NS::HdSceneDelegate*, PXR_NS::HdTaskContext*, PXR_NS::HdDirtyBits* dirtyBits) override;
    void Prepare(PXR_NS::HdTaskContext*, PXR_NS::HdRenderIndex* index) override;
    void Execute(PXR_NS::HdTaskContext*) override;
    const PXR_NS::TfTokenVector& GetRenderTags() const override { return _renderTags; }

    void setCamera(const PXR_NS::SdfPath& camera) { _camera = camera; }
    bool isConverged() const { return _pass->IsConverged(); }
    /// Matrices of the last execution, the projection conformed to the picture's aspect ratio.
    PXR_NS::GfMatrix4d worldToView() const { return _state->GetWorldToViewMatrix(); }
    PXR_NS::GfMatrix4d projection() const { return _state->GetProjectionMatrix(); }

private:
    PXR_NS::SdfPath _camera;
    PXR_NS::GfVec2i _size;
    PXR_NS::TfTokenVector _renderTags;
    PXR_NS::HdRenderPassSharedPtr _pass;
    PXR_NS::HdRenderPassStateSharedPtr _state;
};

} // namespace hipr::record
