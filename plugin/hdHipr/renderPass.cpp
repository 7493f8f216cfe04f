#include "plugin/hdHipr/renderPass.h"

#include "plugin/hdHipr/aov.h"
#include "plugin/hdHipr/camera.h"
#include "plugin/hdHipr/convert.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/renderBuffer.h"
#include "plugin/hdHipr/renderParam.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

/// Lens, exposure and shutter only where the host says which camera it looks through; a free camera may have
/// clip planes.
hipr::CameraDesc cameraOf(HdRenderPassState& state, GfMatrix4d const& crop) { // not const: 20.08
    hipr::CameraDesc desc;
    desc.worldToView = toGlm(state.GetWorldToViewMatrix());
    desc.projection = toGlm(state.GetProjectionMatrix() * crop);
    if (auto const* camera = dynamic_cast<HdHiprCamera const*>(state.GetCamera())) {
        desc.lens = camera->lens();
        desc.exposure = camera->exposure();
        desc.shutter = camera->shutter();
        desc.motion = camera->motion();
    }
    desc.cull = toCullStyle(state.GetCullStyle());
    for (GfVec4d const& plane : state.GetClipPlanes()) {
        desc.clipPlanes.emplace_back(plane[0], plane[1], plane[2], plane[3]);
    }
    if (desc.clipPlanes.size() > hipr::MaxClipPlanes) {
        desc.clipPlanes.resize(hipr::MaxClipPlanes);
        warnOnce("", "only the first " + std::to_string(hipr::MaxClipPlanes) + " clipping planes are used");
    }
    return desc;
}

/// Clip space of a part of the picture, from that of all of it.
GfMatrix4d cropTo(GfVec4f const& window) {
    GfMatrix4d crop(1.0);
    for (int axis = 0; axis < 2; ++axis) {
        const double low = window[axis], high = window[axis + 2];
        crop[axis][axis] = 1.0 / (high - low);
        crop[3][axis] = (1.0 - low - high) / (high - low);
    }
    return crop;
}

} // namespace

HdHiprRenderPass::HdHiprRenderPass(HdRenderIndex* index, HdRprimCollection const& collection,
                                   HdHiprRenderParam& param)
    : HdRenderPass(index, collection), _param(param), _repr(collection.GetReprSelector()) {}

/// Hydra syncs passes before rprims.
void HdHiprRenderPass::_Sync() {
    if (_param.takeRateChange()) {
        GetRenderIndex()->GetChangeTracker().MarkAllRprimsDirty(sampledBits);
    }
}

void HdHiprRenderPass::_MarkCollectionDirty() {
    // A mesh has one shape at a time, that of the repr it synced last: another repr must sync again.
    if (GetRprimCollection().GetReprSelector() == _repr) {
        return;
    }
    _repr = GetRprimCollection().GetReprSelector();
    // (Hydra clears DirtyRepr before it syncs.)
    GetRenderIndex()->GetChangeTracker().MarkAllRprimsDirty(HdChangeTracker::DirtyDisplayStyle);
}

bool HdHiprRenderPass::IsConverged() const {
    return _nothingBound || !_param.canRender() || _param.loop()->converged();
}

HdHiprRenderBuffer* HdHiprRenderPass::bufferOf(HdRenderPassAovBinding const& binding) const {
    HdBprim* buffer = binding.renderBuffer;
    if (!buffer) {
        buffer = GetRenderIndex()->GetBprim(HdPrimTypeTokens->renderBuffer, binding.renderBufferId);
    }
    return dynamic_cast<HdHiprRenderBuffer*>(buffer);
}

bool HdHiprRenderPass::settingOn(const char* name) const {
    return GetRenderIndex()->GetRenderDelegate()->GetRenderSetting<bool>(TfToken(name), true);
}

void HdHiprRenderPass::_Execute(HdRenderPassStateSharedPtr const& state, TfTokenVector const& renderTags) {
    std::vector<AovTarget> targets;
    int width = 0, height = 0;
    for (HdRenderPassAovBinding const& binding : state->GetAovBindings()) {
        HdHiprRenderBuffer* buffer = bufferOf(binding);
        if (!buffer) {
            warnOnce(binding.renderBufferId.GetString(),
                     "AOV '" + binding.aovName.GetString() + "' is bound to no render buffer of HiPR");
            continue;
        }
        targets.push_back({aovRequest(binding.aovName), buffer, buffer->allocation(), binding.clearValue,
                           isDenoised(binding.aovName)});
        width = std::max(width, int(buffer->GetWidth()));
        height = std::max(height, int(buffer->GetHeight()));
    }
    if (!_param.canRender()) {
        for (AovTarget const& target : targets) {
            target.buffer->clear(target.clearValue);
            target.buffer->setConverged(true);
        }
        return;
    }
    _nothingBound = targets.empty();
    if (_nothingBound) {
        warnOnce("", "the host asks for no AOV, so there is nothing to render into");
        return;
    }

    Frame frame;
    const VtValue dataWindow =
        GetRenderIndex()->GetRenderDelegate()->GetRenderSetting(TfToken("hipr:dataWindow"));
    if (dataWindow.IsHolding<GfVec4f>()) {
        frame.camera = cameraOf(*state, cropTo(dataWindow.UncheckedGet<GfVec4f>()));
        frame.rect = {0, 0, width, height};
    } else {
        frame.camera = cameraOf(*state, GfMatrix4d(1.0));
        frame.rect = renderRect(*state, height);
    }
    frame.targets = std::move(targets);
    frame.skyVisible =
        _param.hasDome() && settingOn("domeLightCameraVisibility") && settingOn("enableSceneLights");
    // Hydra does not sync prims whose tag takes them out of the picture, so they are asked here.
    const unsigned int tagVersion = GetRenderIndex()->GetChangeTracker().GetRenderTagVersion();
    if (_renderTagVersion != tagVersion) {
        _renderTagVersion = tagVersion;
        _param.updateRenderTags(*GetRenderIndex());
    }
    _param.setFilter(GetRprimCollection(), renderTags);
    _param.commitEdits();
    _param.loop()->submitFrame(frame);
    _param.loop()->kick();
}

PXR_NAMESPACE_CLOSE_SCOPE
