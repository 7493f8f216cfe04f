#include "testenv/edit/viewer.h"

#include <chrono>
#include <cstring>
#include <map>
#include <stdexcept>
#include <thread>

#include "plugin/hdHipr/renderBuffer.h"
#include "plugin/hdHipr/renderDelegate.h"
#include "plugin/record/skinnedScene.h"
#include "pxr/imaging/hd/camera.h"
#include "pxr/imaging/hd/engine.h"
#include "pxr/imaging/hd/renderPass.h"
#include "pxr/imaging/hd/renderPassState.h"
#include "pxr/imaging/hd/task.h"
#include "pxr/imaging/hd/tokens.h"
#if PXR_VERSION >= 2308
#include "pxr/imaging/cameraUtil/framing.h"
#endif

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::test {

namespace {

const char* const aovNames[] = {"color",
                                "albedo",
                                "depth",
                                "cameraDepth",
                                "normal",
                                "primId",
                                "elementId",
                                "instanceId",
                                "primvars:displayColor",
                                "primvars:st",
                                "CryptoObject00",
                                "CryptoMaterial00",
                                "CryptoAsset00",
                                "motion",
                                "lpe:C<RD>.*",
                                "lpe:C.*<[LO].'key'>"};

class PassTask final : public HdTask {
public:
    explicit PassTask(HdRenderPassSharedPtr pass, HdRenderPassStateSharedPtr state)
        : HdTask(SdfPath::EmptyPath()), pass(std::move(pass)), state(std::move(state)) {}

    void Sync(HdSceneDelegate*, HdTaskContext*, HdDirtyBits* bits) override {
        pass->Sync();
        *bits = HdChangeTracker::Clean;
    }
    void Prepare(HdTaskContext*, HdRenderIndex* index) override {
        const auto* found = static_cast<const HdCamera*>(index->GetSprim(HdPrimTypeTokens->camera, camera));
#if PXR_VERSION < 2308
        state->SetCameraAndViewport(found, GfVec4d(0, 0, size[0], size[1]));
#else
        state->SetCamera(found);
        state->SetFraming(CameraUtilFraming(GfRect2i(GfVec2i(0), size[0], size[1])));
#endif
        state->Prepare(index->GetResourceRegistry());
    }
    void Execute(HdTaskContext*) override {
        pass->Execute(state, tags);
    }
    TfTokenVector const& GetRenderTags() const override {
        return tags;
    }

    HdRenderPassSharedPtr pass;
    HdRenderPassStateSharedPtr state;
    SdfPath camera;
    GfVec2i size{0};
    TfTokenVector tags;
};

TfTokenVector renderTags(const View& view) {
    TfTokenVector tags{HdRenderTagTokens->geometry};
    if (view.render) tags.push_back(HdRenderTagTokens->render);
    if (view.proxy) tags.push_back(HdRenderTagTokens->proxy);
    if (view.guide) tags.push_back(HdRenderTagTokens->guide);
    return tags;
}

} // namespace

struct Viewer::Impl {
    HdHiprRenderDelegate delegate;
    std::unique_ptr<HdRenderIndex> index{HdRenderIndex::New(&delegate, {})};
    std::unique_ptr<record::SkinnedScene> imaging;
    UsdStageRefPtr stage;
    std::map<std::string, HdHiprRenderBuffer*> buffers;
    std::shared_ptr<PassTask> task;
    HdEngine engine;

    Impl();
    ~Impl();
    void resize(const GfVec2i& size);
    void show(const View& view);
    Layer read(const std::string& aov);
};

Viewer::Impl::Impl() {
    const HdRprimCollection everything(HdTokens->geometry, HdReprSelector(HdReprTokens->refined));
    task = std::make_shared<PassTask>(delegate.CreateRenderPass(index.get(), everything),
                                      delegate.CreateRenderPassState());
    HdRenderPassAovBindingVector bindings;
    for (const char* name : aovNames) {
        buffers[name] = static_cast<HdHiprRenderBuffer*>(delegate.CreateBprim(
            HdPrimTypeTokens->renderBuffer, SdfPath("/buffer" + std::to_string(bindings.size()))));
        HdRenderPassAovBinding binding;
        binding.aovName = TfToken(name);
        binding.renderBuffer = buffers[name];
        binding.clearValue = delegate.GetDefaultAovDescriptor(binding.aovName).clearValue;
        bindings.push_back(binding);
    }
    task->state->SetAovBindings(bindings);
}

Viewer::Impl::~Impl() {
    task.reset();
    imaging.reset();
    for (const auto& [name, buffer] : buffers)
        delegate.DestroyBprim(buffer);
    index.reset();
}

void Viewer::Impl::resize(const GfVec2i& size) {
    if (size == task->size) return;
    task->size = size;
    for (const auto& [name, buffer] : buffers) {
        const HdAovDescriptor descriptor = delegate.GetDefaultAovDescriptor(TfToken(name));
        buffer->Allocate(GfVec3i(size[0], size[1], 1), descriptor.format, descriptor.multiSampled);
    }
}

void Viewer::Impl::show(const View& view) {
    // A setting that the view does not name has its default, whatever it was before.
    for (const HdRenderSettingDescriptor& setting : delegate.GetRenderSettingDescriptors()) {
        const auto wanted = view.settings.find(setting.key.GetString());
        delegate.SetRenderSetting(setting.key,
                                  wanted == view.settings.end() ? setting.defaultValue : wanted->second);
    }
    resize(GfVec2i(view.width, view.height));
    task->camera = SdfPath(view.camera);
    task->tags = renderTags(view);
    imaging->SetDisplayRender(view.render);
    imaging->SetDisplayProxy(view.proxy);
    imaging->SetDisplayGuides(view.guide);
    imaging->SetRefineLevelFallback(view.refineLevel);
}

Layer Viewer::Impl::read(const std::string& aov) {
    HdHiprRenderBuffer& buffer = *buffers[aov];
    const HdFormat format = buffer.GetFormat();
    Layer layer{
        aov, unsigned(HdGetComponentCount(format)), HdGetComponentFormat(format) == HdFormatInt32, {}};
    layer.words.resize(size_t(buffer.GetWidth()) * buffer.GetHeight() * layer.components);
    buffer.Resolve();
    std::memcpy(layer.words.data(), buffer.Map(), layer.words.size() * sizeof(uint32_t));
    buffer.Unmap();
    return layer;
}

Viewer::Viewer() : _impl(std::make_unique<Impl>()) {}
Viewer::~Viewer() = default;

void Viewer::tick(const UsdStageRefPtr& stage, const View& view) {
    if (_impl->stage != stage) { // as usdview opens another file: the delegate and its index stay
        _impl->imaging.reset();
        _impl->imaging =
            std::make_unique<record::SkinnedScene>(_impl->index.get(), SdfPath::AbsoluteRootPath());
        _impl->show(view);
        _impl->imaging->SetCameraForSampling(SdfPath(view.camera)); // whose shutter says what moves
        _impl->imaging->Populate(stage->GetPseudoRoot());
        _impl->stage = stage;
    }
    _impl->show(view);
    _impl->imaging->SetCameraForSampling(SdfPath(view.camera));
    _impl->imaging->SetTime(UsdTimeCode(view.time));
    _impl->imaging->ApplyPendingUpdates();
    HdTaskSharedPtrVector tasks{_impl->task};
    _impl->engine.Execute(_impl->index.get(), &tasks);
}

bool Viewer::converged() const {
    return _impl->task->pass->IsConverged();
}

Picture Viewer::picture() {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!converged()) {
        if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("no picture in a minute");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        HdTaskSharedPtrVector tasks{_impl->task};
        _impl->engine.Execute(_impl->index.get(), &tasks);
    }
    Picture picture{_impl->task->size[0], _impl->task->size[1], {}, {}, {}};
    const VtValue scene = _impl->delegate.GetRenderSetting(TfToken("hipr:sceneDump"));
    if (scene.IsHolding<std::string>()) picture.scene = usedFacts(scene.UncheckedGet<std::string>());
    for (const char* name : aovNames)
        if (std::strcmp(name, "primId") != 0) picture.layers.push_back(_impl->read(name));
    const Layer prims = _impl->read("primId"), instances = _impl->read("instanceId");
    std::map<std::pair<uint32_t, uint32_t>, std::string> names;
    for (size_t i = 0; i < prims.words.size(); ++i) {
        std::string& name = names[{prims.words[i], instances.words[i]}];
        const SdfPath rprim = _impl->index->GetRprimPathFromPrimId(int(prims.words[i]));
        if (name.empty() && !rprim.IsEmpty())
            name = _impl->imaging->GetScenePrimPath(rprim, int(instances.words[i])).GetString();
        picture.prims.push_back(name);
    }
    return picture;
}

VtDictionary Viewer::stats() const {
    return _impl->delegate.GetRenderStats();
}

Picture freshPicture(const Scene& scene) {
    Viewer viewer;
    viewer.tick(scene.reopened(), scene.view);
    return viewer.picture();
}

} // namespace hipr::test
