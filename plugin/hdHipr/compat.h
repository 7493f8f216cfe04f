/// @file compat.h
/// The only place, with compatAssets.h, that knows how OpenUSD 20.08 .. 26.x differ. Every other file of the
/// delegate derives from the bases below and calls the helpers below; none of them tests a version but
/// sceneIndices.cpp, which versions before 22.08 have no use for.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "plugin/hdHipr/commands.h"
#include "pxr/base/gf/matrix4d.h"
#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/changeTracker.h"
#include "pxr/imaging/hd/extComputationUtils.h"
#include "pxr/imaging/hd/instancer.h"
#include "pxr/imaging/hd/light.h"
#include "pxr/imaging/hd/material.h"
#include "pxr/imaging/hd/mesh.h"
#include "pxr/imaging/hd/renderDelegate.h"
#include "pxr/imaging/hd/renderIndex.h"
#include "pxr/imaging/hd/renderPassState.h"
#include "pxr/imaging/hd/rendererPlugin.h"
#include "pxr/imaging/hd/sceneDelegate.h"
#include "pxr/imaging/hd/version.h"
#include "pxr/pxr.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// HdRendererPlugin with one question, "can this machine render at all?", behind every form of IsSupported.
/// The answer never depends on the host's GPU: HiPR brings its own Vulkan device.
class RendererPluginBase : public HdRendererPlugin {
public:
    using HdRendererPlugin::IsSupported; // versions differ in how many forms they have besides those below
#if PXR_VERSION < 2302
    bool IsSupported() const final {
        return supported(nullptr);
    }
#elif HD_API_VERSION < 103
    bool IsSupported(bool /*gpuEnabled*/ = true) const final {
        return supported(nullptr);
    }
#endif
#if HD_API_VERSION >= 83 && HD_API_VERSION < 103
    bool IsSupported(HdRendererCreateArgs const&, std::string* why = nullptr) const final {
        return supported(why);
    }
#endif
#if HD_API_VERSION >= 98
    bool IsSupported(HdRendererCreateArgsSchema const&, std::string* why = nullptr) const final {
        return supported(why);
    }
#endif

protected:
    virtual bool supported(std::string* why) const = 0;
};

/// HdRenderDelegate with the prim factories and the render-thread controls in one form.
class RenderDelegateBase : public HdRenderDelegate {
public:
#if PXR_VERSION < 2102
    HdRprim* CreateRprim(TfToken const& type, SdfPath const& id, SdfPath const& instancerId) final {
        return createRprim(type, id, instancerId);
    }
    HdInstancer* CreateInstancer(HdSceneDelegate* delegate, SdfPath const& id,
                                 SdfPath const& parentId) final {
        return createInstancer(delegate, id, parentId);
    }
#else
    HdRprim* CreateRprim(TfToken const& type, SdfPath const& id) final {
        return createRprim(type, id, SdfPath());
    }
    HdInstancer* CreateInstancer(HdSceneDelegate* delegate, SdfPath const& id) final {
        return createInstancer(delegate, id, SdfPath());
    }
#endif
#if PXR_VERSION < 2203
    bool Stop() final {
        return stopRendering();
    }
#else
    bool Stop(bool /*blocking*/ = true) final {
        return stopRendering();
    }
    bool IsStopped() const final {
        return renderingStopped();
    }
    bool IsPaused() const final {
        return renderingPaused();
    }
#endif
#if PXR_VERSION >= 2108
    HdCommandDescriptors GetCommandDescriptors() const final {
        HdCommandDescriptors descriptors;
        for (Command const& command : commands()) {
            HdCommandArgDescriptors arguments;
            for (auto const& [name, value] : command.arguments) {
                arguments.emplace_back(TfToken(name), value);
            }
            descriptors.emplace_back(TfToken(command.name), command.description, arguments);
        }
        return descriptors;
    }
    bool InvokeCommand(TfToken const& command, HdCommandArgs const& arguments) final {
        return runCommand(command, arguments);
    }
#endif
#if PXR_VERSION >= 2305
    TfTokenVector GetRenderSettingsNamespaces() const final {
        return {TfToken("hipr")};
    }
#endif

    // Which outputs of a material count, the first first; without any of these the one for all renderers.
#if PXR_VERSION < 2105
    TfToken GetMaterialNetworkSelector() const final {
        return TfToken("mtlx");
    }
#else
    TfTokenVector GetMaterialRenderContexts() const final {
        return {TfToken("hipr"), TfToken("mtlx")};
    }
#endif

protected:
    RenderDelegateBase() = default;
    explicit RenderDelegateBase(HdRenderSettingsMap const& settings) : HdRenderDelegate(settings) {}

    /// `instancerId` and `parentId` are empty from 21.02 on, where prims learn them while they sync.
    virtual HdRprim* createRprim(TfToken const& type, SdfPath const& id, SdfPath const& instancerId) = 0;
    virtual HdInstancer* createInstancer(HdSceneDelegate* delegate, SdfPath const& id,
                                         SdfPath const& parentId) = 0;
    virtual bool runCommand(TfToken const& name, VtDictionary const& arguments) = 0;
    virtual bool stopRendering() = 0;
    virtual bool renderingStopped() const = 0;
    virtual bool renderingPaused() const = 0;
};

/// HdInstancer whose primvars are synced before use in every version: by Hydra from 21.02 on, on first use by
/// a prototype before.
class InstancerBase : public HdInstancer {
public:
    InstancerBase(HdSceneDelegate* delegate, SdfPath const& id, [[maybe_unused]] SdfPath const& parentId)
#if PXR_VERSION < 2102
        : HdInstancer(delegate, id, parentId){}
#else
        : HdInstancer(delegate, id) {
    }
    void Sync(HdSceneDelegate* delegate, HdRenderParam*, HdDirtyBits* dirtyBits) final {
        _UpdateInstancer(delegate, dirtyBits);
        if (HdChangeTracker::IsAnyPrimvarDirty(*dirtyBits, GetId())) {
            syncPrimvars(*dirtyBits);
        }
    }
#endif

          protected :
        /// Call before primvars are read.
        void ensureSynced() {
#if PXR_VERSION < 2102
        HdChangeTracker& tracker = GetDelegate()->GetRenderIndex().GetChangeTracker();
        std::lock_guard<std::mutex> lock(_syncMutex);
        const HdDirtyBits bits = tracker.GetInstancerDirtyBits(GetId());
        if (HdChangeTracker::IsAnyPrimvarDirty(bits, GetId())) {
            syncPrimvars(bits);
            tracker.MarkInstancerClean(GetId());
        }
#endif
    }
    virtual void syncPrimvars(HdDirtyBits dirtyBits) = 0;

private:
#if PXR_VERSION < 2102
    std::mutex _syncMutex;
#endif
};

/// An HdRprim (or HdMesh) with its instancer, material id and primvars behind one form.
template <class Base> class RprimBase : public Base {
public:
#if PXR_VERSION >= 2203
    void UpdateRenderTag(HdSceneDelegate* delegate, HdRenderParam* renderParam) final {
        HdRprim::UpdateRenderTag(delegate, renderParam);
        renderTagChanged(delegate, renderParam);
    }
#endif

protected:
    RprimBase(SdfPath const& id, [[maybe_unused]] SdfPath const& instancerId)
#if PXR_VERSION < 2102
        : Base(id, instancerId) {
    }
    void syncInstancer(HdSceneDelegate*, HdDirtyBits*){}
#else
        : Base(id) {
    }
    void syncInstancer(HdSceneDelegate* delegate, HdDirtyBits* dirtyBits) {
        this->_UpdateInstancer(delegate, dirtyBits);
        HdInstancer::_SyncInstancerAndParents(delegate->GetRenderIndex(), this->GetInstancerId());
    }
#endif

    void updateMaterialId([[maybe_unused]] HdSceneDelegate* delegate, SdfPath const& materialId) {
#if PXR_VERSION < 2105
        this->_SetMaterialId(delegate->GetRenderIndex().GetChangeTracker(), materialId);
#else
        this->SetMaterialId(materialId);
#endif
    }

    /// The value of a primvar; `indices` is filled only by versions that keep indexed primvars apart.
    VtValue readPrimvar(HdSceneDelegate* delegate, TfToken const& name, VtIntArray* indices) const {
        indices->clear();
#if PXR_VERSION < 2105
        return this->GetPrimvar(delegate, name);
#else
        return this->GetIndexedPrimvar(delegate, name, indices);
#endif
    }

    /// The render tag of the prim changed outside of Sync (22.03 and later).
    virtual void renderTagChanged(HdSceneDelegate* delegate, HdRenderParam* renderParam) = 0;
};

/// The type of clouds of splats; Hydra itself knows it from 26.03 on.
inline TfToken const& particleFieldType() {
    static const TfToken type("particleField");
    return type;
}

/// HdMaterial without the method that left with 20.11.
class MaterialBase : public HdMaterial {
public:
    explicit MaterialBase(SdfPath const& id) : HdMaterial(id) {}
#if PXR_VERSION < 2011
    void Reload() final {}
#endif
};

/// A light parameter by its Hydra name. Scene files written for 21.02 and later author `inputs:<name>`; newer
/// versions of UsdImaging translate that, older ones only know the attribute by the name it is asked for.
inline VtValue lightParam(HdSceneDelegate* delegate, SdfPath const& id, TfToken const& name) {
#if PXR_VERSION < 2102
    VtValue renamed = delegate->GetLightParamValue(id, TfToken("inputs:" + name.GetString()));
    if (!renamed.IsEmpty()) {
        return renamed;
    }
#endif
    return delegate->GetLightParamValue(id, name);
}

/// Whether a prim that is drawn is a light too. Scene indices alone tell, from 22.11 on; before them nobody
/// asks for lights where there are none.
inline bool isLightToo([[maybe_unused]] HdSceneDelegate* delegate, [[maybe_unused]] SdfPath const& id) {
#if PXR_VERSION >= 2211
    return delegate->GetLightParamValue(id, TfToken("isLight")).GetWithDefault<bool>(false);
#else
    return false;
#endif
}

/// HdLight with its instancer: from 23.08 on, lights inside instances reach the renderer.
class LightBase : public HdLight {
public:
    explicit LightBase(SdfPath const& id) : HdLight(id) {}

protected:
#if PXR_VERSION < 2308
    void syncInstancer(HdSceneDelegate*, HdDirtyBits*) {}
    SdfPath instancerId() const {
        return SdfPath();
    }
#else
    void syncInstancer(HdSceneDelegate* delegate, HdDirtyBits* dirtyBits) {
        _UpdateInstancer(delegate, dirtyBits);
        HdInstancer::_SyncInstancerAndParents(delegate->GetRenderIndex(), GetInstancerId());
    }
    SdfPath instancerId() const {
        return GetInstancerId();
    }
#endif
};

/// A light that is linked to a collection was edited, which may have changed the collection. Before 24.08
/// nobody tells the objects in it: they read their categories again.
inline void collectionsChanged([[maybe_unused]] HdRenderIndex& index) {
#if PXR_VERSION < 2408
    index.GetChangeTracker().MarkAllRprimsDirty(HdChangeTracker::DirtyCategories);
#endif
}

/// Which of the grids of one name a field means. Before 20.11 UsdVol has no such attribute, and asking for it
/// is an error.
inline int fieldIndex([[maybe_unused]] HdSceneDelegate* delegate, [[maybe_unused]] SdfPath const& id) {
#if PXR_VERSION >= 2011
    return VtValue::Cast<int>(delegate->Get(id, TfToken("fieldIndex"))).GetWithDefault(0);
#else
    return 0;
#endif
}

/// What a computed primvar is at several times while the shutter is open. Before 21.05 Hydra has no samples
/// of what computations read, and there are none.
inline std::vector<std::pair<float, VtValue>>
computedSamples([[maybe_unused]] HdSceneDelegate* delegate,
                [[maybe_unused]] HdExtComputationPrimvarDescriptor const& primvar) {
    std::vector<std::pair<float, VtValue>> samples;
#if PXR_VERSION >= 2105
    constexpr size_t most = 64;
    HdExtComputationUtils::SampledValueStore<4> values;
    HdExtComputationUtils::SampleComputedPrimvarValues<4>({primvar}, delegate, most, &values);
    auto const& sampled = values[primvar.name];
    for (size_t i = 0; i < sampled.count; ++i) {
        samples.emplace_back(sampled.times[i], sampled.values[i]);
    }
#endif
    return samples;
}

/// How the poles of a dome light's texture lie in its own space (DomeLight_1, from 23.11 on).
inline GfMatrix4d domeOffset([[maybe_unused]] HdSceneDelegate* delegate, [[maybe_unused]] SdfPath const& id) {
#if PXR_VERSION >= 2311
    const VtValue value = delegate->GetLightParamValue(id, HdLightTokens->domeOffset);
    if (value.IsHolding<GfMatrix4d>()) {
        return value.UncheckedGet<GfMatrix4d>();
    }
#endif
    return GfMatrix4d(1.0);
}

/// The transform of a light; before 20.11 it travels as a parameter.
inline GfMatrix4d lightTransform(HdSceneDelegate* delegate, SdfPath const& id) {
#if PXR_VERSION < 2011
    VtValue value = delegate->GetLightParamValue(id, HdTokens->transform);
    if (value.IsEmpty()) {
        value = delegate->Get(id, HdTokens->transform);
    }
    return value.IsHolding<GfMatrix4d>() ? value.UncheckedGet<GfMatrix4d>() : GfMatrix4d(1.0);
#else
    return delegate->GetTransform(id);
#endif
}

/// Whether a light is switched on. From 21.02 on invisible lights also arrive with intensity 0.
inline bool lightVisible(HdSceneDelegate* delegate, SdfPath const& id) {
    return delegate->GetVisible(id);
}

/// A rectangle of pixels inside the render buffers, row 0 at the bottom.
struct PixelRect {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(PixelRect const& o) const {
        return x == o.x && y == o.y && width == o.width && height == o.height;
    }
};

/// The part of the buffers to render; the projection matrix of the state fits exactly this rectangle.
inline PixelRect renderRect(HdRenderPassState const& state, [[maybe_unused]] int bufferHeight) {
#if PXR_VERSION >= 2102
    const CameraUtilFraming framing = state.GetFraming();
    if (framing.IsValid()) {
        const GfRect2i& window = framing.dataWindow; // row 0 at the top
        return {window.GetMinX(), bufferHeight - window.GetMaxY() - 1, window.GetWidth(), window.GetHeight()};
    }
#endif
    const GfVec4f viewport = state.GetViewport();
    return {int(viewport[0]), int(viewport[1]), int(viewport[2]), int(viewport[3])};
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
