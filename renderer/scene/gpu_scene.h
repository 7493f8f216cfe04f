/// @file gpu_scene.h
/// The scene on the device: applies edits to the tables that kernels read, rebuilding only what changed.
#pragma once

#include <unordered_map>

#include "renderer/api/film.h"
#include "renderer/api/settings.h"
#include "renderer/scene/displacement_table.h"
#include "renderer/scene/mesh_lights.h"
#include "renderer/scene/object_table.h"
#include "renderer/shading/categories.h"
#include "renderer/shading/lights.h"
#include "renderer/shading/materials.h"

namespace hipr {

/// Settings that change what is in the scene.
struct SceneOptions {
    bool lights = true, materials = true, domeVisibleToCamera = true, motionBlur = true, shadows = true;
    uint64_t textureBytes = 0; ///< see TextureStore::setLimit()
    bool operator==(const SceneOptions& o) const {
        return lights == o.lights && materials == o.materials &&
               domeVisibleToCamera == o.domeVisibleToCamera && motionBlur == o.motionBlur &&
               shadows == o.shadows && textureBytes == o.textureBytes;
    }
};

/// Used by one thread, while no submission reads the scene.
class GpuScene {
public:
    GpuScene(Device& device, AssetReader assets);

    /// Replaces the traversal; all shapes are built again at the next commit().
    void setTraversal(std::unique_ptr<Traversal> traversal);
    Traversal& traversal() { return *_traversal; }

    /// Records edits; nothing reaches the device before commit().
    ChangedSet apply(const std::vector<SceneEdit::Op>& ops);
    /// Has the files of all textures and IES profiles read again by the next commit(); nothing where there
    /// are none. No submission may be reading the scene.
    ChangedSet reloadTextures();
    /// Returns whether the options differ from the ones before.
    bool setOptions(const SceneOptions& options);
    /// Loads textures, uploads tables, builds acceleration structures. Blocking.
    void commit();

    /// Whether apply() has changed what paths meet or bring home, the camera aside: splats do neither. Before
    /// commit().
    bool tracedChanged() const { return _tracedChanged || _objects.tracedChanged(); }
    /// Where changed objects were: after apply(), before commit().
    std::vector<WorldBox> takeVacated() { return _objects.takeVacated(); }
    /// Adds where changed objects are: after commit().
    void addOccupied(const ChangedSet& changed, std::vector<WorldBox>& regions) const {
        for (const ChangedElement& element : changed.elements)
            _objects.addOccupied(element, regions);
    }
    /// The instances that a changed set is about: after commit().
    std::vector<gpu::ElementKey> keys(const ChangedSet& changed) const {
        std::vector<gpu::ElementKey> keys;
        for (const ChangedElement& element : changed.elements)
            _objects.addKeys(element, keys);
        return keys;
    }

    /// Everything in the scene as text, by name: see SceneDump.
    void dump(std::ostream& out, const Settings& settings) const;

    /// Whether kernels know what is called how (SceneRecord::slotNames); takes effect in commit(). Returns
    /// whether that is new.
    bool keepNames(bool keep) { return _objects.keepNames(keep); }
    /// The names whose ids a Cryptomatte AOV may hold, sorted.
    std::vector<std::string> cryptomatteNames(AovKind kind) const;

    const std::optional<CameraDesc>& camera() const { return _camera; }
    NameTable& names() { return _names; }
    const SplatTable& splats() const { return _splats; }
    /// Where clouds of splats stand: after commit().
    std::vector<SplatPlacement> splatPlacements() const { return _objects.splats(); }
    /// Another one than before: splats() or splatPlacements() may be others.
    uint64_t splatRevision() const { return _objects.splatRevision(); }
    /// Whether there is anything that paths meet: after commit().
    bool anythingTraced() const { return !_objects.records().empty(); }
    /// The camera's, or a closed one where nothing is to be blurred.
    Shutter shutter() const { return _camera && _options.motionBlur ? _camera->shutter : Shutter(); }
    /// Whether something may move while the shutter is open, the camera included.
    bool moves() const {
        return shutter().blurs() &&
               (_camera->motion.size() > 1 || _geometries.anyMotion() || _objects.anyMotion());
    }
    /// Which of SCENE_SHADING_FEATURES the scene will have, as far as can be told before commit().
    uint32_t shadingFeatures() const;
    /// The SceneRecord, once committed.
    VkDeviceAddress address() const { return _record.address(); }
    uint32_t flags() const { return _hostRecord.flags; } ///< SCENE_*
    uint64_t meshHostBytes() const { return _geometries.hostBytes() + _displacement.hostBytes(); }
    uint64_t splatHostBytes() const { return _splats.hostBytes(); }
    uint64_t volumeHostBytes() const { return _volumes.hostBytes(); }
    uint64_t traversalHostBytes() const { return _traversal->hostBytes(); }

private:
    void apply(const SceneEdit::GeometryOp& op, ChangedSet& changed);
    void apply(const SceneEdit::SplatsOp& op, ChangedSet& changed);
    void apply(const SceneEdit::FieldOp& op, ChangedSet& changed);
    void apply(const SceneEdit::VolumeOp& op, ChangedSet& changed);
    void apply(const SceneEdit::VolumeLookOp& op, ChangedSet& changed);
    void apply(const SceneEdit::MaterialOp& op, ChangedSet& changed);
    void apply(const SceneEdit::LightOp& op, ChangedSet& changed);
    void apply(const SceneEdit::ObjectOp& op, ChangedSet& changed);
    void apply(const SceneEdit::InstancesOp& op, ChangedSet& changed);
    void apply(const SceneEdit::CameraOp& op, ChangedSet& changed);
    void commitLights();
    void showLights(bool show);
    uint32_t groupOf(const LightDesc& light);

    Device& _device;
    NameTable _names;
    CategoryTable _categories;
    std::shared_ptr<const ColorManager> _color;
    TextureStore _textures;
    MaterialTable _materials;
    LightTable _lights;
    GeometryTable _geometries;
    DisplacementTable _displacement;
    SplatTable _splats;
    VolumeTable _volumes;
    ObjectTable _objects;
    MeshLights _meshLights;
    std::unique_ptr<Traversal> _traversal;

    std::unordered_map<MaterialId, MaterialDesc> _materialDescs; ///< to tell what an edit changes
    std::map<LightId, LightDesc> _lightDescs;
    std::optional<CameraDesc> _camera;
    SceneOptions _options;
    bool _traversalChanged = true, _tracedChanged = false, _cameraLightReported = false;
    gpu::SceneRecord _hostRecord{};
    Buffer _record;
};

} // namespace hipr
