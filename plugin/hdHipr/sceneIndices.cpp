/// What hosts that feed Hydra from scene indices put between the stage and the delegate: shapes that it does
/// not draw become meshes and curves, and lights know what they are linked to. For others UsdImaging's
/// delegate does all that. (Part of the module, not of the library: nothing refers to it but OpenUSD's plugin
/// registry.)
#include "pxr/pxr.h"

#if PXR_VERSION >= 2208

#include "pxr/imaging/hd/dependencyForwardingSceneIndex.h"
#include "pxr/imaging/hd/retainedDataSource.h"
#include "pxr/imaging/hd/sceneIndexPlugin.h"
#include "pxr/imaging/hd/sceneIndexPluginRegistry.h"
#include "pxr/imaging/hd/tokens.h"
#include "pxr/imaging/hdsi/implicitSurfaceSceneIndex.h"
#if PXR_VERSION >= 2308
#include "pxr/imaging/hdsi/nurbsApproximatingSceneIndex.h"
#endif
#if PXR_VERSION >= 2311
#include "pxr/imaging/hdsi/renderSettingsFilteringSceneIndex.h"
#endif
#if PXR_VERSION >= 2405
#include "pxr/imaging/hdsi/tetMeshConversionSceneIndex.h"
#endif
#if PXR_VERSION >= 2408
#include "pxr/imaging/hdsi/lightLinkingSceneIndex.h"
#endif

PXR_NAMESPACE_OPEN_SCOPE

namespace {

/// As HdsiImplicitSurfaceSceneIndex wants it: what becomes of which shape.
HdContainerDataSourceHandle shapesToMeshes() {
    const HdDataSourceBaseHandle toMesh =
        HdRetainedTypedSampledDataSource<TfToken>::New(HdsiImplicitSurfaceSceneIndexTokens->toMesh);
    const std::vector<TfToken> shapes = {TfToken("sphere"),   TfToken("cube"),    TfToken("cone"),
                                         TfToken("cylinder"), TfToken("capsule"), TfToken("plane")};
    const std::vector<HdDataSourceBaseHandle> fates(shapes.size(), toMesh);
    return HdRetainedContainerDataSource::New(shapes.size(), shapes.data(), fates.data());
}

#if PXR_VERSION >= 2311
/// As HdsiRenderSettingsFilteringSceneIndex wants it: whose attributes are settings of ours.
HdContainerDataSourceHandle settingNamespaces() {
    return HdRetainedContainerDataSource::New(
        HdsiRenderSettingsFilteringSceneIndexTokens->namespacePrefixes,
        HdRetainedTypedSampledDataSource<VtArray<TfToken>>::New({TfToken("hipr")}));
}
#endif

/// Has a mesh look at its light again when that is edited: Hydra knows no dirty bit of meshes for lights, but
/// one for what they are made of.
class MeshLightSceneIndex final : public HdSingleInputFilteringSceneIndexBase {
public:
    explicit MeshLightSceneIndex(HdSceneIndexBaseRefPtr const& input)
        : HdSingleInputFilteringSceneIndexBase(input) {}
    HdSceneIndexPrim GetPrim(SdfPath const& path) const final { return _GetInputSceneIndex()->GetPrim(path); }
    SdfPathVector GetChildPrimPaths(SdfPath const& path) const final {
        return _GetInputSceneIndex()->GetChildPrimPaths(path);
    }

protected:
    void _PrimsAdded(HdSceneIndexBase const&, HdSceneIndexObserver::AddedPrimEntries const& entries) final {
        _SendPrimsAdded(entries);
    }
    void _PrimsRemoved(HdSceneIndexBase const&,
                       HdSceneIndexObserver::RemovedPrimEntries const& entries) final {
        _SendPrimsRemoved(entries);
    }
    void _PrimsDirtied(HdSceneIndexBase const&,
                       HdSceneIndexObserver::DirtiedPrimEntries const& entries) final {
        static const HdDataSourceLocator light(TfToken("light"));
        static const HdDataSourceLocatorSet materials = {HdDataSourceLocator(TfToken("materialBindings")),
                                                         HdDataSourceLocator(TfToken("materialBinding"))};
        HdSceneIndexObserver::DirtiedPrimEntries all = entries;
        for (HdSceneIndexObserver::DirtiedPrimEntry& entry : all) {
            if (entry.dirtyLocators.Intersects(light) &&
                GetPrim(entry.primPath).primType == HdPrimTypeTokens->mesh) {
                entry.dirtyLocators.insert(materials);
            }
        }
        _SendPrimsDirtied(all);
    }
};

} // namespace

class HdHiprSceneIndexPlugin final : public HdSceneIndexPlugin {
protected:
    using HdSceneIndexPlugin::_AppendSceneIndex; // later versions have two forms
    HdSceneIndexBaseRefPtr _AppendSceneIndex(HdSceneIndexBaseRefPtr const& input,
                                             HdContainerDataSourceHandle const&) override {
        HdSceneIndexBaseRefPtr scene = HdsiImplicitSurfaceSceneIndex::New(input, shapesToMeshes());
#if PXR_VERSION >= 2308
        scene = HdsiNurbsApproximatingSceneIndex::New(scene);
#endif
#if PXR_VERSION >= 2405
        scene = HdsiTetMeshConversionSceneIndex::New(scene);
#endif
#if PXR_VERSION >= 2408
        scene = HdsiLightLinkingSceneIndex::New(scene, nullptr);
#endif
#if PXR_VERSION >= 2311
        scene = HdsiRenderSettingsFilteringSceneIndex::New(scene, settingNamespaces());
#endif
        // What a prim is computed from counts as its own edit: render settings from products, for one.
        scene = HdDependencyForwardingSceneIndex::New(scene);
        return TfCreateRefPtr(new MeshLightSceneIndex(scene));
    }
};

TF_REGISTRY_FUNCTION(TfType) {
    HdSceneIndexPluginRegistry::Define<HdHiprSceneIndexPlugin>();
}

TF_REGISTRY_FUNCTION(HdSceneIndexPlugin) {
    // After those of applications, on whose data prims may depend: which render settings are active, say.
    constexpr HdSceneIndexPluginRegistry::InsertionPhase late = 1000;
    HdSceneIndexPluginRegistry::GetInstance().RegisterSceneIndexForRenderer(
        "HiPR", TfToken("HdHiprSceneIndexPlugin"), nullptr, late,
        HdSceneIndexPluginRegistry::InsertionOrderAtEnd);
}

PXR_NAMESPACE_CLOSE_SCOPE

#endif
