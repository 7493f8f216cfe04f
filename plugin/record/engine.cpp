#include "plugin/record/engine.h"

#include <algorithm>
#include <cstring>
#include <unistd.h>

#include "plugin/record/cryptomatte.h"
#include "plugin/record/failure.h"
#include "plugin/record/recordTask.h"
#include "plugin/record/skinnedScene.h"
#include "pxr/base/gf/half.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/imaging/cameraUtil/conformWindow.h"
#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/hd/engine.h"
#include "pxr/imaging/hd/pluginRenderDelegateUniqueHandle.h"
#include "pxr/imaging/hd/renderBuffer.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/rendererPluginRegistry.h"
#include "pxr/imaging/hd/tokens.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

HfPluginDescVector rendererPlugins() {
    HfPluginDescVector plugins;
    HdRendererPluginRegistry::GetInstance().GetPluginDescs(&plugins);
    return plugins;
}

TfToken findRenderer(const std::string& name) {
    for (const HfPluginDesc& plugin : rendererPlugins())
        if (plugin.displayName == name || plugin.id == name) return plugin.id;
    std::string message = "no renderer '" + name + "'. Installed renderers:";
    for (const std::string& installed : listRenderers())
        message += "\n  " + installed;
    throw Failure(ExitRender, message + "\nPXR_PLUGINPATH_NAME names folders with more of them.");
}

TfTokenVector renderTags(const std::vector<std::string>& purposes) {
    TfTokenVector tags;
    for (const std::string& purpose : purposes)
        tags.push_back(purpose == "default" ? HdRenderTagTokens->geometry : TfToken(purpose));
    return tags;
}

/// How a camera is fitted to a picture of another aspect.
CameraUtilConformWindowPolicy windowPolicy(const std::string& conformPolicy) {
    if (conformPolicy == "cropAperture") return CameraUtilCrop;
    if (conformPolicy == "expandAperture") return CameraUtilFit;
    if (conformPolicy == "adjustApertureHeight") return CameraUtilMatchHorizontally;
    if (conformPolicy == "adjustPixelAspectRatio") return CameraUtilDontConform;
    return CameraUtilMatchVertically; // adjustApertureWidth, and what usdview does
}

bool contains(const std::vector<std::string>& list, const char* item) {
    return std::find(list.begin(), list.end(), item) != list.end();
}

/// The words of one value of a format: normalised bytes and halves become floats.
void copyPixel(const uint8_t* source, HdFormat component, size_t count, uint32_t* words) {
    for (size_t i = 0; i < count; ++i) {
        float value = 0.f;
        switch (component) {
        case HdFormatFloat32:
        case HdFormatInt32:
            std::memcpy(&words[i], source + 4 * i, 4);
            continue;
        case HdFormatUNorm8:
            value = float(source[i]) / 255.f;
            break;
        case HdFormatSNorm8:
            value = std::max(-1.f, float(int8_t(source[i])) / 127.f);
            break;
        case HdFormatFloat16: {
            GfHalf half;
            std::memcpy(&half, source + 2 * i, 2);
            value = float(half);
            break;
        }
        default:
            break;
        }
        std::memcpy(&words[i], &value, 4);
    }
}

void storeMatrix(const GfMatrix4d& matrix, float* out) {
    for (int i = 0; i < 16; ++i)
        out[i] = float(matrix.GetArray()[i]);
}

/// A picture that cannot fit would have the system end the whole process, or others, instead of an error.
/// Each buffer is held by the renderer, twice by Hydra, and once for the file.
void requireMemory(const HdRenderDelegate& delegate, const EngineOptions& options, const DataWindow& window) {
    double pixelBytes = 0;
    for (const std::string& aov : options.aovs)
        pixelBytes += double(HdDataSizeOfFormat(delegate.GetDefaultAovDescriptor(TfToken(aov)).format));
    const double needed = 4.0 * pixelBytes * window.width * window.height;
    const double installed = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
    if (needed > installed)
        throw Failure(ExitRender,
                      TfStringPrintf("a picture of %d x %d pixels with these AOVs needs %.0f GiB of memory; "
                                     "this machine has %.0f GiB",
                                     window.width, window.height, needed / (1 << 30), installed / (1 << 30)));
}

} // namespace

struct Engine::Impl {
    struct Aov {
        std::string name;
        HdRenderBuffer* buffer = nullptr;
    };

    HdPluginRenderDelegateUniqueHandle delegate;
    std::unique_ptr<HdRenderIndex> index;
    std::unique_ptr<SkinnedScene> scene;
    std::vector<Aov> aovs;
    std::shared_ptr<RecordTask> task;
    HdEngine hydra;
    int width = 0, height = 0; ///< of the buffers
    PictureFraming framing;

    ~Impl();
    Aov makeAov(const std::string& name);
    Layer readLayer(const Aov& aov) const;
};

Engine::Impl::~Impl() {
    // Rendering may still run: it stops with the render pass, before the buffers it writes to go.
    task.reset();
    scene.reset();
    for (Aov& aov : aovs) {
        aov.buffer->Finalize(delegate->GetRenderParam());
        delegate->DestroyBprim(aov.buffer);
    }
    index.reset();
}

Engine::Impl::Aov Engine::Impl::makeAov(const std::string& name) {
    const HdAovDescriptor descriptor = delegate->GetDefaultAovDescriptor(TfToken(name));
    const SdfPath id("/hiprrecord/aov" + std::to_string(aovs.size()));
    HdBprim* prim = delegate->CreateBprim(HdPrimTypeTokens->renderBuffer, id);
    Aov aov{name, dynamic_cast<HdRenderBuffer*>(prim)};
    if (!aov.buffer) throw Failure(ExitRender, "the renderer has no render buffers");
    if (!aov.buffer->Allocate(GfVec3i(width, height, 1), descriptor.format, descriptor.multiSampled)) {
        delegate->DestroyBprim(prim);
        throw Failure(ExitRender, "the renderer cannot allocate the AOV '" + name + "' of " +
                                      std::to_string(width) + " x " + std::to_string(height) + " pixels");
    }
    return aov;
}

Layer Engine::Impl::readLayer(const Aov& aov) const {
    const HdFormat format = aov.buffer->GetFormat(), component = HdGetComponentFormat(format);
    const size_t count = HdGetComponentCount(format), pixelBytes = HdDataSizeOfFormat(format);
    if (aov.buffer->GetWidth() != unsigned(width) || aov.buffer->GetHeight() != unsigned(height))
        throw Failure(ExitRender, "the renderer changed the size of the AOV '" + aov.name + "'");
    Layer layer{aov.name, int(count), component == HdFormatInt32, {}};
    layer.words.resize(size_t(width) * size_t(height) * count);
    aov.buffer->Resolve();
    const auto* data = static_cast<const uint8_t*>(aov.buffer->Map());
    if (!data) throw Failure(ExitRender, "the renderer gave no pixels for the AOV '" + aov.name + "'");
    // Hydra's buffers begin at the bottom, image files at the top.
    for (size_t y = 0; y < size_t(height); ++y)
        for (size_t x = 0; x < size_t(width); ++x)
            copyPixel(data + ((size_t(height) - 1 - y) * size_t(width) + x) * pixelBytes, component, count,
                      &layer.words[(y * size_t(width) + x) * count]);
    aov.buffer->Unmap();
    return layer;
}

Engine::Engine(const std::string& renderer, const std::string& device) : _impl(std::make_unique<Impl>()) {
    const TfToken id = findRenderer(renderer);
    HdRenderSettingsMap settings;
    if (!device.empty()) settings[TfToken("hipr:device")] = VtValue(device);
    _impl->delegate = HdRendererPluginRegistry::GetInstance().CreateRenderDelegate(id, settings);
    if (!_impl->delegate)
        throw Failure(ExitRender, "the renderer '" + renderer + "' cannot run on this machine");
}

Engine::~Engine() = default;

HdRenderDelegate& Engine::delegate() const {
    return *_impl->delegate;
}

std::string Engine::rendererName() const {
    HfPluginDesc plugin;
    HdRendererPluginRegistry::GetInstance().GetPluginDesc(_impl->delegate.GetPluginId(), &plugin);
    return plugin.displayName;
}

bool Engine::hasAov(const std::string& aov) const {
    const HdAovDescriptor descriptor = _impl->delegate->GetDefaultAovDescriptor(TfToken(aov));
    // HiPR describes AOVs it does not know too, so that every host finds a buffer, and marks them.
    return descriptor.format != HdFormatInvalid && descriptor.aovSettings.count(TfToken("hipr:unknown")) == 0;
}

void Engine::populate(const UsdStageRefPtr& stage, const SdfPath& camera, const EngineOptions& options) {
    const DataWindow window = options.window.value_or(DataWindow{0, 0, options.width, options.height});
    requireMemory(*_impl->delegate, options, window);
    _impl->width = window.width;
    _impl->height = window.height;
    _impl->index.reset(HdRenderIndex::New(_impl->delegate.Get(), {}));
    if (!_impl->index) throw Failure(ExitRender, "Hydra does not accept the renderer");

    _impl->scene = std::make_unique<SkinnedScene>(_impl->index.get(), SdfPath::AbsoluteRootPath());
    _impl->scene->SetDisplayRender(contains(options.purposes, "render"));
    _impl->scene->SetDisplayProxy(contains(options.purposes, "proxy"));
    _impl->scene->SetDisplayGuides(contains(options.purposes, "guide"));
    _impl->scene->SetWindowPolicy(windowPolicy(options.conformPolicy));
    _impl->scene->SetRefineLevelFallback(options.refineLevel);
    _impl->scene->SetCameraForSampling(camera); // whose shutter says what moves
    _impl->scene->Populate(stage->GetPseudoRoot());

    HdRenderPassAovBindingVector bindings;
    for (const std::string& name : options.aovs) {
        _impl->aovs.push_back(_impl->makeAov(name));
        HdRenderPassAovBinding binding;
        binding.aovName = TfToken(name);
        binding.renderBuffer = _impl->aovs.back().buffer;
        binding.clearValue = _impl->delegate->GetDefaultAovDescriptor(binding.aovName).clearValue;
        bindings.push_back(binding);
    }
    _impl->framing = {GfVec2i(options.width, options.height), options.pixelAspect, window};
    if (windowPolicy(options.conformPolicy) == CameraUtilDontConform) _impl->framing.pixelAspect.reset();
    _impl->task = std::make_shared<RecordTask>(_impl->index.get(), camera, _impl->framing, bindings,
                                               renderTags(options.purposes));
}

void Engine::setFrame(double frame) {
    _impl->scene->SetTime(UsdTimeCode(frame));
    _impl->scene->ApplyPendingUpdates();
}

void Engine::setCamera(const SdfPath& camera) {
    _impl->scene->SetCameraForSampling(camera);
    _impl->task->setCamera(camera);
}

bool Engine::step() {
    HdTaskSharedPtrVector tasks{_impl->task};
    _impl->hydra.Execute(_impl->index.get(), &tasks);
    return _impl->task->isConverged();
}

Picture Engine::read() {
    Picture picture;
    picture.width = _impl->width;
    picture.height = _impl->height;
    picture.info.x = _impl->framing.window.x;
    picture.info.y = _impl->framing.window.y;
    picture.info.fullWidth = _impl->framing.size[0];
    picture.info.fullHeight = _impl->framing.size[1];
    picture.info.pixelAspect = _impl->task->pixelAspect();
    for (const Impl::Aov& aov : _impl->aovs)
        picture.layers.push_back(_impl->readLayer(aov));
    storeMatrix(_impl->task->worldToView(), picture.info.worldToCamera);
    storeMatrix(_impl->task->worldToView() * _impl->task->projection(), picture.info.worldToNdc);
    return picture;
}

VtDictionary Engine::stats() const {
    return _impl->delegate->GetRenderStats();
}

void Engine::publishEveryBatch() {
    _impl->delegate->SetRenderSetting(TfToken("hipr:publishEveryBatch"), VtValue(true));
}

void Engine::publishNow() {
    _impl->delegate->GetRenderSetting(TfToken("hipr:publishNow"));
}

std::string Engine::whyMissing(const std::string& aov) const {
    const HdAovDescriptor descriptor = _impl->delegate->GetDefaultAovDescriptor(TfToken(aov));
    const auto reason = descriptor.aovSettings.find(TfToken("hipr:missing"));
    return reason != descriptor.aovSettings.end() ? reason->second.GetWithDefault<std::string>() : "";
}

std::string Engine::sceneDump() const {
    const VtValue text = _impl->delegate->GetRenderSetting(TfToken("hipr:sceneDump"));
    if (!text.IsHolding<std::string>())
        throw Failure(ExitUsage,
                      "--dump-scene: the renderer " + rendererName() + " cannot tell what it holds");
    return text.UncheckedGet<std::string>();
}

std::vector<std::string> Engine::cryptomatteNames(const std::string& aov) const {
    const VtValue names = _impl->delegate->GetRenderSetting(TfToken("hipr:cryptomatte:" + aov));
    if (!names.IsHolding<VtArray<std::string>>()) return {};
    const auto list = names.UncheckedGet<VtArray<std::string>>();
    return {list.cbegin(), list.cend()};
}

std::vector<std::string> listRenderers() {
    std::vector<std::string> names;
    for (const HfPluginDesc& plugin : rendererPlugins())
        names.push_back(plugin.displayName);
    return names;
}

std::vector<std::string> listAovs(const Engine& engine) {
    TfTokenVector candidates = HdAovTokens->allTokens;
    candidates.insert(candidates.end(),
                      {TfToken("albedo"), TfToken("denoised"), TfToken("variance"), TfToken("sampleCount")});
    std::vector<std::string> names;
    for (const char* stem : {"CryptoObject", "CryptoMaterial", "CryptoAsset"})
        for (const std::string& layer : expandedAov(stem))
            candidates.emplace_back(layer);
    for (const TfToken& token : candidates)
        if (token.GetString().back() != ':' && engine.hasAov(token.GetString()))
            names.push_back(token.GetString());
    return names;
}

} // namespace hipr::record
