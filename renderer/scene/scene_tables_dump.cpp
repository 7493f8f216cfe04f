// What the tables of the scene say of themselves.
#include <algorithm>

#include "renderer/scene/gpu_scene.h"
#include "renderer/scene/scene_dump.h"

namespace hipr {
namespace {

void dumpPrimvars(SceneDump::Element& out, const char* instance, std::vector<Primvar> primvars) {
    std::sort(primvars.begin(), primvars.end(),
              [](const Primvar& a, const Primvar& b) { return a.name < b.name; });
    for (const Primvar& primvar : primvars)
        out.fact(instance, "primvar", primvar.name, primvar.components, primvar.values.size(),
                 contentHash(primvar.values), "indices", primvar.indices.size(),
                 contentHash(primvar.indices));
}

} // namespace

void GeometryTable::dump(SceneDump& dump) const {
    for (const auto& [id, entry] : _entries)
        dumpMesh(dump, *entry.mesh);
}

// The primId is left out: hosts number prims in the order in which they came. So are categories: objects may
// be in some that no light names any more.
void ObjectTable::dump(SceneDump& dump, const GeometryTable& geometries, const SplatTable& splats,
                       const VolumeTable& volumes, const MaterialNames& nameOf) const {
    for (const auto& [id, entry] : _entries) {
        SceneDump::Element& out = dump.element("object", entry.desc ? entry.desc->name : "");
        out.fact("visible", entry.desc && entry.desc->visible);
        out.fact("rendered", placedCount(entry) > 0);
        out.fact("nonOpaque", (entry.placed.flags & gpu::INSTANCE_NON_OPAQUE) != 0);
        if (!entry.desc) continue;
        const Geometry* geometry = geometries.find(entry.desc->geometry);
        out.fact("geometry", geometry ? geometry->mesh->name : std::string());
        const SplatSet* set = splats.find(entry.desc->splats);
        out.fact("splats", set ? set->cloud->name : std::string());
        const VolumeEntry* volume = volumes.find(entry.desc->volume);
        out.fact("volume", volume ? volume->desc.name : std::string());
        for (uint32_t slot = 0; slot < entry.desc->materials.size(); ++slot)
            out.fact("slot", slot, "bound", nameOf.byId(entry.desc->materials[slot]));
        for (uint32_t slot = 0; slot < entry.placed.materialCount; ++slot)
            out.fact("slot", slot, "shown",
                     nameOf.byIndex(_materialIndices[entry.placed.firstMaterial + slot]));
        if (const SurfaceLight* light = entry.desc->light.get()) {
            out.fact("diffuse", light->diffuse, "specular", light->specular);
            dumpLightControls(out, light->shaping, light->shadow, light->lightLink, light->shadowLink);
        }
        dumpInstances(out, entry);
    }
}

void VolumeTable::dump(SceneDump& dump, const MaterialNames& nameOf) const {
    const auto describe = [](SceneDump::Element& out, const VolumeLook& look) {
        out.fact("look", look.absorption, look.scattering, look.anisotropy, look.emission,
                 look.temperatureScale, look.emissionByDensity);
    };
    for (const auto& [id, look] : _looks)
        describe(dump.element("volumeLook", nameOf.byId(id)), look);
    for (const auto& [id, entry] : _volumes) {
        SceneDump::Element& out = dump.element("volume", entry.desc.name);
        describe(out, entry.desc.look);
        const std::pair<const char*, FieldId> fields[] = {{"density", entry.desc.density},
                                                          {"emission", entry.desc.emission},
                                                          {"temperature", entry.desc.temperature},
                                                          {"color", entry.desc.color}};
        for (const auto& [role, field] : fields) {
            const auto found = _fields.find(field);
            if (found == _fields.end()) continue;
            const FieldGrid& grid = *found->second.grid;
            out.fact(role, grid.name, grid.channels, grid.first, grid.bricks, grid.latticeToObject);
            out.fact(role, "bricks", contentHash(grid.index), "values", grid.values.size(),
                     contentHash(grid.values));
        }
    }
}

void ObjectTable::dumpInstances(SceneDump::Element& out, const Entry& entry) const {
    static const InstancesDesc once{
        {glm::mat4x3(1.f)}, {}, {}, {}, {}}; // what an object without any stands for
    const InstancesDesc& instances = entry.instances ? *entry.instances : once;
    out.fact("instances", instances.transforms.size());
    dumpPrimvars(out, "instance", instances.primvars);
    for (size_t i = 0; i < instances.transforms.size(); ++i) {
        out.fact("instance", i, "transform", instances.transforms[i]);
        for (size_t t = 0; t < instances.motion.times.size(); ++t)
            out.fact("instance", i, "at", instances.motion.times[t], instances.motion.transforms[t][i]);
        out.fact("instance", i, "id", i < instances.instanceIds.size() ? instances.instanceIds[i] : int(i));
    }
    for (uint32_t i = 0; i < entry.placed.count; ++i) {
        const gpu::InstanceRecord& record = _records[entry.placed.first + i];
        out.fact("record", i, "instance", entry.usable[i], "id", record.instanceId, "transform",
                 record.objectToWorld, "keys", record.keyCount,
                 contentHash(_keys.data() + record.firstKey, record.keyCount * sizeof(glm::mat4x3)));
    }
}

void GpuScene::dump(std::ostream& out, const Settings& settings) const {
    SceneDump dump;
    if (_camera) dumpCamera(dump, *_camera);
    MaterialNames names;
    names.indices = _materials.indices();
    for (const auto& [id, desc] : _materialDescs) {
        names.names[id] = desc.name;
        dumpMaterial(dump, desc, _materials.nonOpaque(id));
    }
    for (const auto& [id, desc] : _lightDescs)
        dumpLight(dump, desc, _lights.emits(id));
    _geometries.dump(dump);
    _splats.dump(dump);
    _volumes.dump(dump, names);
    _objects.dump(dump, _geometries, _splats, _volumes, names);
    SceneDump::Element& options = dump.element("option", "scene");
    options.fact("lights", _options.lights);
    options.fact("materials", _options.materials);
    options.fact("domeVisibleToCamera", _options.domeVisibleToCamera);
    options.fact("emittingLights", _lights.count()); // a camera light included
    for (const SettingInfo& info : settingTable())
        std::visit([&](const auto& value) { dump.element("setting", info.name).fact(value); },
                   readSetting(settings, info.name));
    dump.write(out);
}

} // namespace hipr
