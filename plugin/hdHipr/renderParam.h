/// @file renderParam.h
/// HdHiprRenderParam: the only mutable door from Hydra into the renderer.
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <unordered_map>

#include "plugin/hdHipr/fieldFile.h"
#include "plugin/hdHipr/meshLight.h"
#include "plugin/hdHipr/renderLoop.h"
#include "plugin/hdHipr/sampling.h"
#include "pxr/imaging/hd/rprimCollection.h"

PXR_NAMESPACE_OPEN_SCOPE

class HdHiprRenderBuffer;

namespace hdhipr {

/// An object as Hydra describes it; whether it is drawn also depends on what the render pass includes.
struct ObjectState {
    hipr::ObjectDesc desc; ///< `desc.visible` is the prim's own visibility
    SdfPath path;
    TfToken renderTag;
};

} // namespace hdhipr

/// Prims fill an edit while they sync, on any thread; commitEdits hands it to the render thread once Hydra
/// has synced everything, so that no half-synced scene is ever rendered. Nothing here waits for rendering.
class HdHiprRenderParam final : public HdRenderParam {
public:
    /// Without a usable Vulkan device the reason is reported and everything else does nothing.
    explicit HdHiprRenderParam(hipr::RendererOptions const& options);

    bool canRender() const { return _loop != nullptr; }
    hdhipr::RenderLoop* loop() { return _loop.get(); }

    /// The edit to fill. Thread-safe.
    hipr::SceneEdit& edit() { return _edit; }

    template <class Id> Id newId() { return Id(++_lastId); }

    /// The material of a path. A mesh may ask before the material has synced, or when it never does.
    hipr::MaterialId materialId(SdfPath const& path);

    /// A material of the scene has been edited, or is gone.
    void setMaterial(SdfPath const& path, std::optional<hipr::MaterialDesc> const& desc);
    hdhipr::ShiningMaterials& shiningMaterials() { return _shiningMaterials; }
    hdhipr::ShownFields& shownFields() { return _shownFields; }

    /// The field of a path, likewise.
    hipr::FieldId fieldId(SdfPath const& path);

    void setObject(hipr::ObjectId id, hdhipr::ObjectState const& state);
    void removeObject(hipr::ObjectId id);

    /// Asks the render index for the tag of every object.
    void updateRenderTags(HdRenderIndex const& index);

    /// Lights go through here so that it is known whether a dome fills the background.
    void setLight(hipr::LightId id, hipr::LightDesc const& desc);
    void removeLight(hipr::LightId id);
    bool hasDome();

    /// Returns whether prims have to be sampled anew: the shutter opens or closes otherwise than before.
    bool setShutter(SdfPath const& camera, hipr::Shutter const& shutter);
    /// The camera goes, perhaps to come back at once: UsdImaging makes some anew that were edited.
    void dropShutter(SdfPath const& camera);
    /// How long the shutters of all cameras together are open, and how fast time runs then.
    hdhipr::Sampling sampling();
    void setFramesPerSecond(double framesPerSecond);
    /// Whether prims have to be sampled anew since this was asked last, because time runs otherwise.
    bool takeRateChange();

    /// What the render pass draws. Objects outside of it become invisible.
    void setFilter(HdRprimCollection const& collection, TfTokenVector const& renderTags);

    /// Hands the collected edit to the render thread.
    void commitEdits();

    /// The buffer is about to go away.
    void releaseBuffer(HdHiprRenderBuffer* buffer);

private:
    bool included(hdhipr::ObjectState const& state) const;
    void emitObject(hipr::ObjectId id, hdhipr::ObjectState const& state);

    std::unique_ptr<hdhipr::RenderLoop> _loop;
    hipr::SceneEdit _edit;
    std::atomic<uint32_t> _lastId{0};
    hdhipr::ShiningMaterials _shiningMaterials;
    hdhipr::ShownFields _shownFields;

    std::mutex _mutex; ///< guards everything below
    std::unordered_map<SdfPath, hipr::MaterialId, SdfPath::Hash> _materials;
    std::unordered_map<SdfPath, hipr::FieldId, SdfPath::Hash> _fields;
    std::unordered_map<hipr::ObjectId, hdhipr::ObjectState> _objects;
    std::set<hipr::LightId> _domes; ///< those that are switched on
    std::map<SdfPath, hipr::Shutter> _openShutters;
    bool _shutterDropped = false; ///< since the last setShutter()
    double _framesPerSecond = hipr::Settings().framesPerSecond;
    bool _rateChanged = false; ///< since the last takeRateChange()
    SdfPathVector _rootPaths, _excludePaths;
    TfTokenVector _renderTags;
};

PXR_NAMESPACE_CLOSE_SCOPE
