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

RecordTask::RecordTask(HdRenderIndex* index, const SdfPath& camera, const PictureFraming& framing,
                       const HdRenderPassAovBindingVector& bindings, const TfTokenVector& renderTags)
    : HdTask(SdfPath::EmptyPath()), _camera(camera), _framing(framing), _renderTags(renderTags) {
    HdRenderDelegate* delegate = index->GetRenderDelegate();
    if (!HydraHasFraming && !framing.isPlain())
        delegate->SetRenderSetting(TfToken("hipr:dataWindow"), VtValue(windowNdc()));
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
    const float aspect = _framing.pixelAspect.value_or(1.f);
    const GfVec2f size(_framing.size);
#if PXR_VERSION < 2308
    _state->SetCameraAndViewport(camera, GfVec4d(0, 0, double(size[0]) * aspect, size[1]));
#else
    const DataWindow& window = _framing.window;
    const GfVec2f origin(float(-window.x), float(-window.y)); // of the picture, in pixels of the buffers
    _state->SetCamera(camera);
    _state->SetFraming(CameraUtilFraming(GfRange2f(origin, origin + size),
                                         GfRect2i(GfVec2i(0), window.width, window.height), aspect));
#endif
    _state->Prepare(index->GetResourceRegistry());
}

/// The data window in parts of the picture, from its bottom left.
GfVec4f RecordTask::windowNdc() const {
    const DataWindow& window = _framing.window;
    const float width = float(_framing.size[0]), height = float(_framing.size[1]);
    return {float(window.x) / width, 1.f - float(window.y + window.height) / height,
            float(window.x + window.width) / width, 1.f - float(window.y) / height};
}

GfMatrix4d RecordTask::projection() const {
    GfMatrix4d whole(1.0); // from clip space of what the state's projection fills to that of the picture
    if (HydraHasFraming) {
        const GfVec4f window = windowNdc();
        for (int axis = 0; axis < 2; ++axis) {
            whole[axis][axis] = window[axis + 2] - window[axis];
            whole[3][axis] = window[axis] + window[axis + 2] - 1.0;
        }
    }
    return _state->GetProjectionMatrix() * whole;
}

float RecordTask::pixelAspect() const {
    if (_framing.pixelAspect) return *_framing.pixelAspect;
    const GfMatrix4d p = projection();
    return float(p[1][1] / p[0][0] * _framing.size[1] / _framing.size[0]);
}

void RecordTask::Execute(HdTaskContext*) {
    _pass->Execute(_state, _renderTags);
}

} // namespace hipr::record
