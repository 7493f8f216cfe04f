#include "plugin/record/recordTask.h"

#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/repr.h"
#include "pxr/imaging/hd/rprimCollection.h"
#include "pxr/imaging/hd/tokens.h"

#if PXR_VERSION >= 2308
#include "pxr/imaging/cameraUtil/framing.h"
#endif

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

RecordTask::RecordTask(HdRenderIndex* index, const SdfPath& camera, const GfVec2i& size,
                       const HdRenderPassAovBindingVector& bindings, const TfTokenVector& renderTags)
    : HdTask(SdfPath::EmptyPath()), _camera(camera), _size(size), _renderTags(renderTags) {
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
#if PXR_VERSION < 2308
    _state->SetCameraAndViewport(camera, GfVec4d(0, 0, _size[0], _size[1]));
#else
    _state->SetCamera(camera);
    _state->SetFraming(CameraUtilFraming(GfRect2i(GfVec2i(0), _size[0], _size[1])));
#endif
    _state->Prepare(index->GetResourceRegistry());
}

void RecordTask::Execute(HdTaskContext*) {
    _pass->Execute(_state, _renderTags);
}

} // namespace hipr::record
