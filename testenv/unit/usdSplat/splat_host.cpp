#include "testenv/unit/usdSplat/splat_host.h"

#include <stdexcept>

#include "plugin/hdHipr/instancer.h"
#include "plugin/hdHipr/splatCloud.h"
#include "pxr/base/plug/registry.h"
#include "pxr/base/tf/error.h"
#include "pxr/base/tf/errorMark.h"
#include "pxr/imaging/hd/engine.h"
#include "pxr/imaging/hd/renderPass.h"
#include "pxr/imaging/hd/resourceRegistry.h"
#include "pxr/imaging/hd/task.h"
#include "pxr/imaging/hd/tokens.h"
#include "pxr/usd/sdf/layer.h"
#include "pxr/usdImaging/usdImaging/delegate.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace {

using Synced = std::map<std::string, SyncedSplats>;

class ProbeRprim final : public hdhipr::RprimBase<HdRprim> {
public:
    ProbeRprim(SdfPath const& id, SdfPath const& instancerId, Synced& synced)
        : RprimBase(id, instancerId), _synced(synced) {
        _synced[id.GetString()];
    }
    ~ProbeRprim() override { _synced.erase(GetId().GetString()); }

    HdDirtyBits GetInitialDirtyBitsMask() const override {
        return HdChangeTracker::AllSceneDirtyBits & ~HdDirtyBits(HdChangeTracker::Varying);
    }
    void Sync(HdSceneDelegate* delegate, HdRenderParam*, HdDirtyBits* bits, TfToken const&) override {
        syncInstancer(delegate, bits);
        SyncedSplats& out = _synced[GetId().GetString()];
        ++out.syncs;
        if (HdChangeTracker::IsPrimvarDirty(*bits, GetId(), TfToken("positions"))) {
            out.cloud = hdhipr::readSplatCloud(*delegate, GetId());
            ++out.valueSyncs;
        }
        out.visible = delegate->GetVisible(GetId());
        out.renderTag = delegate->GetRenderTag(GetId());
        const hipr::InstancesDesc instances = hdhipr::readInstances(*delegate, GetId(), GetInstancerId(), {});
        out.places.clear();
        for (glm::mat4x3 const& transform : instances.transforms) {
            out.places.emplace_back(transform[3].x, transform[3].y, transform[3].z);
            out.up = GfVec3d(transform[1].x, transform[1].y, transform[1].z);
        }
        *bits = HdChangeTracker::Clean;
    }
    TfTokenVector const& GetBuiltinPrimvarNames() const override { return hdhipr::splatPrimvarNames(); }

protected:
    void _InitRepr(TfToken const&, HdDirtyBits*) override {}
    HdDirtyBits _PropagateDirtyBits(HdDirtyBits bits) const override { return bits; }
    void renderTagChanged(HdSceneDelegate*, HdRenderParam*) override {}

private:
    Synced& _synced;
};

class ProbePass final : public HdRenderPass {
public:
    ProbePass(HdRenderIndex* index, HdRprimCollection const& collection) : HdRenderPass(index, collection) {}

private:
    void _Execute(HdRenderPassStateSharedPtr const&, TfTokenVector const&) override {}
};

class ProbeDelegate final : public hdhipr::RenderDelegateBase {
public:
    explicit ProbeDelegate(Synced& synced) : _synced(synced) {}
    TfTokenVector const& GetSupportedRprimTypes() const override {
        static const TfTokenVector types{hdhipr::particleFieldType()};
        return types;
    }
    TfTokenVector const& GetSupportedSprimTypes() const override { return _none; }
    TfTokenVector const& GetSupportedBprimTypes() const override { return _none; }
    HdResourceRegistrySharedPtr GetResourceRegistry() const override { return _resources; }
    HdRenderPassSharedPtr CreateRenderPass(HdRenderIndex* index, HdRprimCollection const& c) override {
        return std::make_shared<ProbePass>(index, c);
    }
    void DestroyInstancer(HdInstancer* instancer) override { delete instancer; }
    void DestroyRprim(HdRprim* rprim) override { delete rprim; }
    HdSprim* CreateSprim(TfToken const&, SdfPath const&) override { return nullptr; }
    HdSprim* CreateFallbackSprim(TfToken const&) override { return nullptr; }
    void DestroySprim(HdSprim*) override {}
    HdBprim* CreateBprim(TfToken const&, SdfPath const&) override { return nullptr; }
    HdBprim* CreateFallbackBprim(TfToken const&) override { return nullptr; }
    void DestroyBprim(HdBprim*) override {}
    void CommitResources(HdChangeTracker*) override {}

protected:
    HdRprim* createRprim(TfToken const&, SdfPath const& id, SdfPath const& instancerId) override {
        return new ProbeRprim(id, instancerId, _synced);
    }
    HdInstancer* createInstancer(HdSceneDelegate* delegate, SdfPath const& id,
                                 SdfPath const& parentId) override {
        return new HdHiprInstancer(delegate, id, parentId);
    }
    bool stopRendering() override { return false; }
    bool renderingStopped() const override { return true; }
    bool renderingPaused() const override { return false; }
    bool runCommand(TfToken const&, VtDictionary const&) override { return false; }

private:
    Synced& _synced;
    TfTokenVector _none;
    HdResourceRegistrySharedPtr _resources = std::make_shared<HdResourceRegistry>();
};

class ProbeTask final : public HdTask {
public:
    explicit ProbeTask(HdRenderPassSharedPtr pass) : HdTask(SdfPath::EmptyPath()), _pass(std::move(pass)) {}
    void Sync(HdSceneDelegate*, HdTaskContext*, HdDirtyBits* bits) override {
        _pass->Sync();
        *bits = HdChangeTracker::Clean;
    }
    void Prepare(HdTaskContext*, HdRenderIndex*) override {}
    void Execute(HdTaskContext*) override {}
    TfTokenVector const& GetRenderTags() const override { return _tags; }

private:
    HdRenderPassSharedPtr _pass;
    TfTokenVector _tags{HdRenderTagTokens->geometry, HdRenderTagTokens->render, HdRenderTagTokens->proxy,
                        HdRenderTagTokens->guide};
};

} // namespace

struct SplatHost::Impl {
    Synced synced;
    ProbeDelegate delegate{synced};
    std::unique_ptr<HdRenderIndex> index{HdRenderIndex::New(&delegate, {})};
    std::unique_ptr<UsdImagingDelegate> imaging =
        std::make_unique<UsdImagingDelegate>(index.get(), SdfPath::AbsoluteRootPath());
    HdTaskSharedPtr task;
    HdEngine engine;
};

SplatHost::SplatHost(UsdStageRefPtr const& stage) : _impl(std::make_unique<Impl>()) {
    const HdRprimCollection everything(HdTokens->geometry, HdReprSelector(HdReprTokens->refined));
    _impl->task =
        std::make_shared<ProbeTask>(_impl->delegate.CreateRenderPass(_impl->index.get(), everything));
    _impl->imaging->SetDisplayGuides(true);
    _impl->imaging->Populate(stage->GetPseudoRoot());
}

SplatHost::~SplatHost() {
    _impl->task.reset();
    _impl->imaging.reset();
    _impl->index.reset();
}

std::map<std::string, SyncedSplats> const& SplatHost::update(double time) {
    _impl->imaging->SetTime(UsdTimeCode(time));
    _impl->imaging->ApplyPendingUpdates();
    HdTaskSharedPtrVector tasks{_impl->task};
    _impl->engine.Execute(_impl->index.get(), &tasks);
    return _impl->synced;
}

void registerSplatPlugins() {
    [[maybe_unused]] static const auto plugins = PlugRegistry::GetInstance().RegisterPlugins(HIPR_PLUGIN_DIR);
}

UsdStageRefPtr splatStage(std::string const& text) {
    registerSplatPlugins();
    const SdfLayerRefPtr layer = SdfLayer::CreateAnonymous("test.usda");
    TfErrorMark errors;
    if (layer->ImportFromString("#usda 1.0\n" + text)) {
        return UsdStage::Open(layer);
    }
    std::string why;
    for (TfError const& error : errors) {
        why += error.GetCommentary();
    }
    throw std::runtime_error(why);
}

PXR_NAMESPACE_CLOSE_SCOPE
