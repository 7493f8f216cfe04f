#include "plugin/record/recordTask.h"

#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/repr.h"
#include "pxr/imaging/hd/rprimCollection.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

RecordTask::RecordTask(HdRenderIndex* index, const SdfPath& camera, const GfVec4d& viewport,
                       const HdRenderPassAovBindingVector& bindings, const TfTokenVector& renderTags)
    : HdTask(SdfPath::EmptyPath()), _camera(camera), _viewport(viewport), _renderTags(renderTags) {
    HdRenderDelegate* delegate = index->GetRenderDelegate();
    const HdRprimCollection everything(HdTokens->geometry, HdReprSelector(HdReprTokens->refined));
    _pass = delegate->CreateRenderPass(index, everything);
    _state = delegate->CreateRenderPassState();
    _state->SetAovBindings(bindings);
}

void RecordTask::Sync(HdSceneDelegate*, HdTaskContext*, HdDirtyBits* dirtyBits) {
    _pass->Sync();
    *dirtyBits = HdChangeTracker::Clean;
}

void RecordTask::Prepare(HdTaskContext*, HdRenderIndex* index) {
    const auto* camera = static_cast<const HdCamera*>(index->GetSprim(HdPrimTypeTokens->camera, _camera));
    _state->SetCameraAndViewport(camera, _viewport);
    _state->Prepare(index->GetResourceRegistry());
    _pass->Prepare(_renderTags);
}

void RecordTask::Execute(HdTaskContext*) {
    _state->Bind();
    _pass->Execute(_state, _renderTags);
    _state->Unbind();
}

} // namespace hipr::record
