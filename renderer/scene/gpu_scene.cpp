#include "renderer/scene/gpu_scene.h"

#include <unordered_set>

#include <glm/gtc/constants.hpp>

namespace hipr {
namespace {

/// Stands in when nothing else lights the scene; never an id of newId().
constexpr LightId CameraLight = LightId(std::numeric_limits<uint32_t>::max());

/// A headlight: a matte surface that faces the camera shows its own colour.
LightDesc cameraLight(const CameraDesc& camera) {
    LightDesc light;
    light.name = "camera light";
    light.kind = LightKind::Distant;
    light.transform = glm::inverse(camera.worldToView);
    light.normalize = true;
    light.intensity = glm::pi<float>();
    light.angle = 2.f;
    return light;
}

Change lightChange(const LightDesc& a, const LightDesc& b) {
    LightDesc moved = a, switched = a;
    moved.transform = b.transform;
    switched.visible = b.visible;
    if (a == b) return Change::None;
    if (moved == b) return Change::Transform;
    if (switched == b) return Change::Visibility;
    return a.transform == b.transform ? Change::Emission : Change::Emission | Change::Transform;
}

/// Marks the instances that a later call for the same object replaces.
std::vector<bool> superseded(const std::vector<SceneEdit::Op>& ops) {
    std::vector<bool> result(ops.size());
    std::unordered_set<ObjectId> later;
    for (size_t i = ops.size(); i-- > 0;)
        if (const auto* op = std::get_if<SceneEdit::InstancesOp>(&ops[i]))
            result[i] = !later.insert(op->id).second;
    return result;
}

/// One entry for each element. Single instances are left alone: they are named once as it is.
void mergeElements(ChangedSet& changed) {
    std::unordered_map<uint64_t, size_t> seen;
    std::vector<ChangedElement> merged;
    merged.reserve(changed.elements.size());
    for (const ChangedElement& element : changed.elements) {
        const uint64_t id = std::visit(
            [](const auto& e) {
                if constexpr (std::is_same_v<std::decay_t<decltype(e)>, std::monostate>)
                    return uint64_t(0);
                else
                    return uint64_t(e);
            },
            element.element);
        const bool whole = element.instance == ChangedElement::AllInstances;
        const auto [at, isNew] =
            whole ? seen.try_emplace(uint64_t(element.element.index()) << 32 | id, merged.size())
                  : std::pair(seen.end(), true);
        if (isNew)
            merged.push_back(element);
        else
            merged[at->second].change = merged[at->second].change | element.change;
    }
    changed.elements = std::move(merged);
}

} // namespace

GpuScene::GpuScene(Device& device, AssetReader assets)
    : _device(device), _categories(device), _color(ColorManager::create(device.messages())),
      _textures(device, assets, _color), _materials(device, _names, _textures),
      _lights(device, _textures, _categories), _geometries(device, _names),
      _displacement(std::move(assets), _color, device.messages()), _volumes(device),
      _objects(device, _names, _categories), _meshLights(device),
      _record(device.createBuffer(sizeof(gpu::SceneRecord), MemoryUse::Device, "Scene")) {}

void GpuScene::setTraversal(std::unique_ptr<Traversal> traversal) {
    _traversal = std::move(traversal);
    _traversalChanged = true;
    _geometries.resubmit();
}

ChangedSet GpuScene::apply(const std::vector<SceneEdit::Op>& ops) {
    ChangedSet changed;
    const std::vector<bool> skip = superseded(ops);
    for (size_t i = 0; i < ops.size(); ++i)
        if (!skip[i]) std::visit([&](const auto& o) { apply(o, changed); }, ops[i]);
    _displacement.update(_geometries, _objects, changed);
    mergeElements(changed);
    return changed;
}

/// Hands all lights to the table, or takes them from it.
void GpuScene::showLights(bool show) {
    for (const auto& [id, desc] : _lightDescs) {
        if (show)
            _lights.set(id, desc, groupOf(desc));
        else
            _lights.remove(id);
    }
}

/// Whoever shows a file lets go of it, so that all are freed, and asks for it again.
ChangedSet GpuScene::reloadTextures() {
    ChangedSet changed;
    for (const auto& [id, desc] : _materialDescs) {
        _materials.set(id, MaterialDesc());
        _displacement.removeMaterial(id);
    }
    showLights(false);
    _displacement.update(_geometries, _objects, changed);
    const bool profiles = _lights.forgetProfiles();
    const bool any = _textures.commit() || profiles || !changed.empty();
    for (const auto& [id, desc] : _materialDescs) {
        _materials.set(id, desc);
        _displacement.setMaterial(id, desc);
        const Change emission = _materials.emissive(id) ? Change::Emission : Change::None;
        changed.elements.push_back({id, Change::Material | emission});
    }
    showLights(_options.lights);
    for (const auto& [id, desc] : _lightDescs)
        if (!desc.texture.empty() || !desc.shaping.iesFile.empty())
            changed.elements.push_back({id, Change::Emission});
    if (!any) return {};
    _objects.profilesChanged(changed);
    _displacement.update(_geometries, _objects, changed);
    _tracedChanged = true;
    mergeElements(changed);
    return changed;
}

void GpuScene::apply(const SceneEdit::GeometryOp& op, ChangedSet& changed) {
    if (!op.mesh)
        _displacement.removeGeometry(op.id);
    else if (_displacement.setGeometry(op.id, op.mesh))
        return;
    const Change change = op.mesh ? _geometries.set(op.id, op.mesh)
                                  : (_geometries.remove(op.id) ? Change::Removed : Change::None);
    if (change != Change::None) _objects.geometryChanged(op.id, change, changed);
}

void GpuScene::apply(const SceneEdit::SplatsOp& op, ChangedSet& changed) {
    const Change change =
        op.cloud ? _splats.set(op.id, op.cloud) : (_splats.remove(op.id) ? Change::Removed : Change::None);
    if (change != Change::None) _objects.splatsChanged(op.id, changed);
}

void GpuScene::apply(const SceneEdit::FieldOp& op, ChangedSet& changed) {
    const bool any =
        op.grid ? _volumes.setField(op.id, op.grid) != Change::None : _volumes.removeField(op.id);
    if (!any) return;
    for (const VolumeId volume : _volumes.showing(op.id))
        _objects.volumeChanged(volume, Change::Geometry, changed);
}

void GpuScene::apply(const SceneEdit::VolumeOp& op, ChangedSet& changed) {
    const Change change = op.desc ? _volumes.setVolume(op.id, *op.desc)
                                  : (_volumes.removeVolume(op.id) ? Change::Removed : Change::None);
    if (change != Change::None) _objects.volumeChanged(op.id, change, changed);
}

void GpuScene::apply(const SceneEdit::VolumeLookOp& op, ChangedSet& changed) {
    const Change change = op.look ? _volumes.setLook(op.id, *op.look)
                                  : (_volumes.removeLook(op.id) ? Change::Removed : Change::None);
    if (change == Change::None) return;
    changed.elements.push_back({op.id, change == Change::Removed ? Change::Material : change});
    _tracedChanged = true;
}

void GpuScene::apply(const SceneEdit::MaterialOp& op, ChangedSet& changed) {
    auto it = _materialDescs.find(op.id);
    if (!op.desc) {
        if (it == _materialDescs.end()) return;
        _materialDescs.erase(it);
        _materials.remove(op.id);
        _displacement.removeMaterial(op.id);
        changed.elements.push_back({op.id, Change::Removed});
        _tracedChanged = true;
        return;
    }
    if (it != _materialDescs.end() && it->second == *op.desc) return;
    const bool emitted = _materials.emissive(op.id);
    _materials.set(op.id, *op.desc);
    _displacement.setMaterial(op.id, *op.desc);
    Change change = it == _materialDescs.end() ? Change::Added : Change::Material;
    if (emitted || _materials.emissive(op.id)) change = change | Change::Emission;
    _materialDescs[op.id] = *op.desc;
    changed.elements.push_back({op.id, change});
    _tracedChanged = true;
}

void GpuScene::apply(const SceneEdit::LightOp& op, ChangedSet& changed) {
    auto it = _lightDescs.find(op.id);
    Change change = Change::None;
    if (!op.desc) {
        if (it == _lightDescs.end()) return;
        change = Change::Removed;
        _lightDescs.erase(it);
        _lights.remove(op.id);
    } else {
        change = it == _lightDescs.end() ? Change::Added : lightChange(it->second, *op.desc);
        if (change == Change::None) return;
        _lightDescs[op.id] = *op.desc;
        if (_options.lights) _lights.set(op.id, *op.desc, groupOf(*op.desc));
    }
    changed.elements.push_back({op.id, change});
    _tracedChanged = true;
}

void GpuScene::apply(const SceneEdit::ObjectOp& op, ChangedSet& changed) {
    _displacement.objectsChanged();
    if (op.desc)
        _objects.setObject(op.id, *op.desc, changed);
    else
        _objects.removeObject(op.id, changed);
}

void GpuScene::apply(const SceneEdit::InstancesOp& op, ChangedSet& changed) {
    _objects.setInstances(op.id, op.desc, changed);
}

void GpuScene::apply(const SceneEdit::CameraOp& op, ChangedSet& changed) {
    if (_camera && *_camera == op.desc) return;
    _camera = op.desc;
    _objects.setViewCull(op.desc.cull);
    changed.elements.push_back({std::monostate(), Change::Camera});
}

uint32_t GpuScene::groupOf(const LightDesc& light) {
    return light.group.empty() ? gpu::NO_INDEX : _names.intern(light.group);
}

bool GpuScene::setOptions(const SceneOptions& options) {
    if (options == _options) return false;
    if (options.lights != _options.lights) showLights(options.lights);
    _options = options;
    _lights.setShadows(options.shadows);
    _textures.setLimit(options.textureBytes);
    _displacement.setEnabled(options.materials);
    ChangedSet unused; // a setting changed, with all that follows
    _displacement.update(_geometries, _objects, unused);
    return true;
}

uint32_t GpuScene::shadingFeatures() const {
    uint32_t features = 0;
    if (_options.materials) {
        features |= _materials.features();
        if (_materials.anyEmissive()) features |= gpu::SCENE_HAS_MESH_LIGHTS; // most likely
    }
    if (shutter().blurs() && (_geometries.anyMotion() || _objects.anyMotion()))
        features |= gpu::SCENE_HAS_MOTION;
    if (_geometries.anySegments()) features |= gpu::SCENE_HAS_SEGMENTS;
    return features;
}

void GpuScene::commit() {
    _textures.commit();
    _materials.commit();
    _geometries.setShutter(shutter());
    _objects.setShutter(shutter());
    _geometries.commit(*_traversal);
    const MaterialTable* const materials = _options.materials ? &_materials : nullptr;
    if (_objects.commit(_geometries, _splats, _volumes, materials) || _traversalChanged)
        _traversal->setInstances(_objects.instances());
    _traversal->commit();
    _traversalChanged = _tracedChanged = false;
    _volumes.commit(_objects.volumes());

    _meshLights.commit(_objects, _geometries, materials);
    _hostRecord = {};
    _objects.describe(_hostRecord);
    commitLights();
    _lights.describe(_hostRecord);
    _categories.commit();
    _categories.describe(_hostRecord);
    _geometries.describe(_hostRecord);
    _materials.describe(_hostRecord);
    _textures.describe(_hostRecord);
    _volumes.describe(_hostRecord);
    _hostRecord.bvh = _traversal->sceneAddress();
    _hostRecord.flags |= shadingFeatures() & ~gpu::SCENE_HAS_MESH_LIGHTS; // of which the lights know better
    if (!_options.domeVisibleToCamera) _hostRecord.flags |= gpu::SCENE_DOME_HIDDEN_FROM_CAMERA;
    _device.upload(_record, &_hostRecord, sizeof(_hostRecord));
}

// Pictures must not be black for want of a light. Lights that are switched off are there on purpose, though.
// Meshes that emit are no lights here, unless they are said to be: viewers light scenes without light prims
// from the camera, whatever glows in them.
void GpuScene::commitLights() {
    const bool none = !_options.lights || (_lightDescs.empty() && !_objects.anyLights());
    if (_camera && none) {
        _lights.set(CameraLight, cameraLight(*_camera));
        if (!_cameraLightReported)
            _device.messages()(Severity::Info, "", "no light in the scene; lighting it from the camera");
        _cameraLightReported = true;
    } else {
        _lights.remove(CameraLight);
    }
    _lights.setMeshes(_meshLights.lights(), _hostRecord.instanceCount);
    _lights.commit(_hostRecord.boundsMin, _hostRecord.boundsMax);
}

} // namespace hipr
