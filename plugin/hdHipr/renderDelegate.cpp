#include "plugin/hdHipr/renderDelegate.h"

#include <sstream>
#include <sys/resource.h>

#include "plugin/hdHipr/aov.h"
#include "plugin/hdHipr/assets.h"
#include "plugin/hdHipr/basisCurves.h"
#include "plugin/hdHipr/camera.h"
#include "plugin/hdHipr/commands.h"
#include "plugin/hdHipr/field.h"
#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/light.h"
#include "plugin/hdHipr/material.h"
#include "plugin/hdHipr/mesh.h"
#include "plugin/hdHipr/messages.h"
#include "plugin/hdHipr/particleField.h"
#include "plugin/hdHipr/points.h"
#include "plugin/hdHipr/renderBuffer.h"
#include "plugin/hdHipr/renderParam.h"
#include "plugin/hdHipr/renderPass.h"
#include "plugin/hdHipr/renderSettings.h"
#include "plugin/hdHipr/renderSettingsPrim.h"
#include "plugin/hdHipr/volume.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/imaging/hd/extComputation.h"
#include "pxr/imaging/hd/resourceRegistry.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_OPEN_SCOPE

using namespace hdhipr;

namespace {

/// The device can be chosen only when a delegate is made.
const char* const deviceKey = "hipr:device";
const char* const everyBatchKey = "hipr:publishEveryBatch";
const char* const sceneDumpKey = "hipr:sceneDump";
const char* const commandKey = "hipr:command";
const char* const publishNowKey = "hipr:publishNow";
const char* const cryptomatteKey = "hipr:cryptomatte:"; // and the AOV: the names of its manifest
const char* const dataWindowKey = "hipr:dataWindow";

hipr::RendererOptions rendererOptions(HdRenderSettingsMap const& settings) {
    hipr::RendererOptions options;
    options.messages = report;
    options.assets = assetReader();
    const auto device = settings.find(TfToken(deviceKey));
    if (device != settings.end()) {
        const VtValue text = VtValue::Cast<std::string>(device->second);
        if (text.IsHolding<std::string>()) {
            options.device = text.UncheckedGet<std::string>();
        }
    }
    return options;
}

uint64_t peakMemory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return uint64_t(usage.ru_maxrss) * 1024; // Linux counts KiB
}

} // namespace

HdHiprRenderDelegate::HdHiprRenderDelegate() : HdHiprRenderDelegate(HdRenderSettingsMap()) {}

HdHiprRenderDelegate::HdHiprRenderDelegate(HdRenderSettingsMap const& settings)
    : RenderDelegateBase(settings), _param(std::make_unique<HdHiprRenderParam>(rendererOptions(settings))),
      _resources(std::make_shared<HdResourceRegistry>()) {
    for (auto const& [key, value] : settings) {
        if (key != deviceKey) {
            storeSetting(key, value);
        }
    }
    if (_param->canRender()) {
        _param->loop()->submitSettings(_settings);
    }
}

HdHiprRenderDelegate::~HdHiprRenderDelegate() = default;

HdRenderParam* HdHiprRenderDelegate::GetRenderParam() const {
    return _param.get();
}

TfTokenVector const& HdHiprRenderDelegate::GetSupportedRprimTypes() const {
    static const TfTokenVector types = {HdPrimTypeTokens->mesh, HdPrimTypeTokens->basisCurves,
                                        HdPrimTypeTokens->points, HdPrimTypeTokens->volume,
                                        particleFieldType()};
    return types;
}

TfTokenVector const& HdHiprRenderDelegate::GetSupportedSprimTypes() const {
    static const TfTokenVector types = {
        HdPrimTypeTokens->camera,       HdPrimTypeTokens->material,  HdPrimTypeTokens->extComputation,
        HdPrimTypeTokens->domeLight,    HdPrimTypeTokens->rectLight, HdPrimTypeTokens->sphereLight,
        HdPrimTypeTokens->distantLight, HdPrimTypeTokens->diskLight, HdPrimTypeTokens->cylinderLight};
    return types;
}

TfTokenVector const& HdHiprRenderDelegate::GetSupportedBprimTypes() const {
    static const TfTokenVector types = {
#if PXR_VERSION >= 2311
        HdPrimTypeTokens->renderSettings,
#endif
        HdPrimTypeTokens->renderBuffer,
        vdbFieldType()
    };
    return types;
}

HdRprim* HdHiprRenderDelegate::createRprim(TfToken const& type, SdfPath const& id,
                                           SdfPath const& instancerId) {
    if (type == HdPrimTypeTokens->mesh) {
        return new HdHiprMesh(id, instancerId, *_param);
    }
    if (type == HdPrimTypeTokens->basisCurves) {
        return new HdHiprBasisCurves(id, instancerId, *_param);
    }
    if (type == HdPrimTypeTokens->points) {
        return new HdHiprPoints(id, instancerId, *_param);
    }
    if (type == HdPrimTypeTokens->volume) {
        return new HdHiprVolume(id, instancerId, *_param);
    }
    if (type == particleFieldType()) {
        return new HdHiprParticleField(id, instancerId, *_param);
    }
    warnOnce(id.GetString(), "prims of type '" + type.GetString() + "' are not supported");
    return nullptr;
}

void HdHiprRenderDelegate::DestroyRprim(HdRprim* rprim) {
    delete rprim;
}

HdInstancer* HdHiprRenderDelegate::createInstancer(HdSceneDelegate* delegate, SdfPath const& id,
                                                   SdfPath const& parentId) {
    return new HdHiprInstancer(delegate, id, parentId);
}

void HdHiprRenderDelegate::DestroyInstancer(HdInstancer* instancer) {
    delete instancer;
}

HdSprim* HdHiprRenderDelegate::CreateSprim(TfToken const& type, SdfPath const& id) {
    if (type == HdPrimTypeTokens->camera) {
        return new HdHiprCamera(id);
    }
    if (type == HdPrimTypeTokens->material) {
        return new HdHiprMaterial(id);
    }
    if (type == HdPrimTypeTokens->extComputation) {
        return new HdExtComputation(id);
    }
    if (HdHiprLight::handles(type)) {
        return new HdHiprLight(id, type);
    }
    warnOnce(id.GetString(), "prims of type '" + type.GetString() + "' are not supported");
    return nullptr;
}

HdSprim* HdHiprRenderDelegate::CreateFallbackSprim(TfToken const& type) {
    // Fallback prims never sync, so they never reach the renderer.
    return CreateSprim(type, SdfPath::EmptyPath());
}

void HdHiprRenderDelegate::DestroySprim(HdSprim* sprim) {
    delete sprim;
}

HdBprim* HdHiprRenderDelegate::CreateBprim(TfToken const& type, SdfPath const& id) {
    if (type == HdPrimTypeTokens->renderBuffer) {
        return new HdHiprRenderBuffer(id);
    }
    if (type == vdbFieldType()) {
        return new HdHiprField(id);
    }
#if PXR_VERSION >= 2311
    if (type == HdPrimTypeTokens->renderSettings) {
        return new HdHiprRenderSettings(id);
    }
#endif
    warnOnce(id.GetString(), "prims of type '" + type.GetString() + "' are not supported");
    return nullptr;
}

HdBprim* HdHiprRenderDelegate::CreateFallbackBprim(TfToken const& type) {
    return CreateBprim(type, SdfPath::EmptyPath());
}

void HdHiprRenderDelegate::DestroyBprim(HdBprim* bprim) {
    // Not every host finalizes the buffers it made itself.
    if (auto* buffer = dynamic_cast<HdHiprRenderBuffer*>(bprim)) {
        _param->releaseBuffer(buffer);
    }
    delete bprim;
}

HdRenderPassSharedPtr HdHiprRenderDelegate::CreateRenderPass(HdRenderIndex* index,
                                                             HdRprimCollection const& collection) {
    return std::make_shared<HdHiprRenderPass>(index, collection, *_param);
}

void HdHiprRenderDelegate::CommitResources(HdChangeTracker*) {
    _param->commitEdits();
}

HdAovDescriptor HdHiprRenderDelegate::GetDefaultAovDescriptor(TfToken const& name) const {
    return aovDescriptor(name);
}

TfToken HdHiprRenderDelegate::GetMaterialBindingPurpose() const {
    return HdTokens->full;
}

bool HdHiprRenderDelegate::storeSetting(TfToken const& key, VtValue const& value) {
    if (key == everyBatchKey) {
        if (_param->canRender()) {
            _param->loop()->setPublishEveryBatch(VtValue::Cast<bool>(value).GetWithDefault(false));
        }
        return false;
    }
    if (key == commandKey) {
        runCommand(TfToken(VtValue::Cast<std::string>(value).GetWithDefault<std::string>()), {});
        return false;
    }
    const SettingResult result = assignRenderSetting(_settings, key, value);
    _param->setFramesPerSecond(_settings.framesPerSecond);
    if (result == SettingResult::Unknown) {
        if (TfStringStartsWith(key.GetString(), "hipr:") && key != dataWindowKey) {
            warnOnce("", key == deviceKey ? "the device can be chosen only when the renderer is created"
                                          : "there is no render setting '" + key.GetString() + "'");
        }
        _settingsMap[key] = value;
    }
    return result == SettingResult::Changed;
}

void HdHiprRenderDelegate::SetRenderSetting(TfToken const& key, VtValue const& value) {
    if (!storeSetting(key, value)) {
        return;
    }
    ++_settingsVersion;
    if (_param->canRender()) {
        _param->loop()->submitSettings(_settings);
    }
}

VtValue HdHiprRenderDelegate::GetRenderSetting(TfToken const& key) const {
    if (key == sceneDumpKey && _param->canRender()) {
        std::ostringstream text;
        _param->loop()->whenIdle([&](hipr::Renderer& renderer) { renderer.dumpScene(text); });
        return VtValue(text.str());
    }
    if (key == publishNowKey && _param->canRender()) {
        _param->loop()->publishNow();
        return VtValue(true);
    }
    for (auto const& [stem, kind] : cryptomatteKinds) {
        if (_param->canRender() && key == std::string(cryptomatteKey) + stem) {
            VtArray<std::string> names;
            _param->loop()->whenIdle([&, of = kind](hipr::Renderer& renderer) {
                const std::vector<std::string> list = renderer.cryptomatteNames(of);
                names.assign(list.begin(), list.end());
            });
            return VtValue(names);
        }
    }
    const VtValue value = readRenderSetting(_settings, key);
    return value.IsEmpty() ? HdRenderDelegate::GetRenderSetting(key) : value;
}

HdRenderSettingDescriptorList HdHiprRenderDelegate::GetRenderSettingDescriptors() const {
    return settingDescriptors();
}

VtDictionary HdHiprRenderDelegate::GetRenderStats() const {
    VtDictionary stats;
    if (!_param->canRender()) {
        return stats;
    }
    const LoopStats loop = _param->loop()->stats();
    const hipr::Progress& progress = loop.progress;
    stats["percentDone"] = _param->loop()->converged() ? 100.0 : 100.0 * progress.fraction;
    stats[HdPerfTokens->numCompletedSamples.GetString()] = int(progress.samplesDone);
    stats["totalClockTime"] = progress.seconds;
    stats["hipr:paths"] = progress.pathsTraced;
    stats["hipr:rays"] = progress.raysTraced;
    stats["hipr:tiles"] = int(progress.tiles);
    stats["hipr:tilesDiscovered"] = int(progress.tilesDiscovered);
    stats["hipr:firstRevealTime"] = progress.firstRevealSeconds;
    stats["hipr:scheduleShare"] = progress.seconds > 0 ? progress.scheduleSeconds / progress.seconds : 0.0;
    stats["hipr:changes"] = loop.changes;
    stats["hipr:changedElements"] = loop.changedElements;
    stats["hipr:lastChange"] = hipr::toString(loop.lastChange);
    stats["hipr:pictures"] = _param->loop()->pictures();
    stats["hipr:denoiseTime"] = loop.denoiseSeconds;
    stats["hipr:failed"] = int(progress.failed);
    stats["hipr:device"] = _param->loop()->renderer().device().name;
    stats["peakMemory"] = peakMemory();
    for (hipr::MemoryReport::Row const& row : loop.memory.rows) {
        stats["hipr:memory:" + row.kind] = row.bytes;
    }
    return stats;
}

bool HdHiprRenderDelegate::Pause() {
    if (!_param->canRender()) {
        return false;
    }
    _param->loop()->pause();
    return true;
}

bool HdHiprRenderDelegate::Resume() {
    if (!_param->canRender()) {
        return false;
    }
    _param->loop()->resume();
    return true;
}

bool HdHiprRenderDelegate::runCommand(TfToken const& name, VtDictionary const& arguments) {
    return _param->canRender() && invokeCommand(*_param, name, arguments);
}

bool HdHiprRenderDelegate::stopRendering() {
    if (!_param->canRender()) {
        return false;
    }
    _param->loop()->stop();
    return true;
}

bool HdHiprRenderDelegate::Restart() {
    if (!_param->canRender()) {
        return false;
    }
    _param->loop()->restart();
    return true;
}

bool HdHiprRenderDelegate::renderingStopped() const {
    return !_param->canRender() || _param->loop()->stopped();
}

bool HdHiprRenderDelegate::renderingPaused() const {
    return _param->canRender() && _param->loop()->paused();
}

PXR_NAMESPACE_CLOSE_SCOPE
