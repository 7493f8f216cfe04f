#include "renderer/scene/object_table.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/instance_diff.h"
#include "renderer/scene/placements.h"
#include "renderer/shading/mesh_light.h"

namespace hipr {
namespace {

/// Whether a motion has a placement for every instance and time.
bool complete(const InstanceMotion& motion, size_t instances) {
    return motion.times.size() == motion.transforms.size() &&
           std::all_of(motion.transforms.begin(), motion.transforms.end(),
                       [&](const auto& transforms) { return transforms.size() == instances; });
}

bool isTranslucent(const std::vector<Primvar>& primvars) {
    for (const Primvar& primvar : primvars)
        if (primvar.name == "displayOpacity")
            return std::any_of(primvar.values.begin(), primvar.values.end(), [](float v) { return v < 1.f; });
    return false;
}

} // namespace

bool ObjectTable::Placement::operator==(const Placement& o) const {
    return first == o.first && count == o.count && geometry == o.geometry &&
           firstMaterial == o.firstMaterial && materialCount == o.materialCount && flags == o.flags &&
           primId == o.primId && categories == o.categories && firstKey == o.firstKey &&
           keyCount == o.keyCount;
}

void ObjectTable::note(ChangedSet& changed, ObjectId id, const Entry& entry, Change change,
                       uint32_t instance) {
    if (change == Change::None) return;
    changed.elements.push_back({id, change, instance});
    _tracedChanged |=
        entry.placed.count > 0 || !entry.volumes.empty() ||
        (entry.desc && (entry.desc->geometry != GeometryId::None || entry.desc->volume != VolumeId::None));
}

void ObjectTable::setObject(ObjectId id, const ObjectDesc& desc, ChangedSet& changed) {
    Entry& entry = _entries[id];
    Change change = Change::None;
    if (!entry.desc) {
        entry.fresh = true;
        change = Change::Added;
    } else if (!entry.fresh) {
        if (entry.desc->geometry != desc.geometry || entry.desc->splats != desc.splats ||
            entry.desc->volume != desc.volume)
            change = change | Change::Geometry;
        if (entry.desc->materials != desc.materials) change = change | Change::Material;
        if (entry.desc->visible != desc.visible || entry.desc->cull != desc.cull)
            change = change | Change::Visibility;
        if (entry.desc->primId != desc.primId || entry.desc->asset != desc.asset ||
            entry.desc->lightGroup != desc.lightGroup)
            change = change | Change::Primvar;
        if (entry.desc->categories != desc.categories) change = change | Change::Linking;
        if (!sameLight(entry.desc->light, desc.light)) change = change | Change::Emission;
        if (change != Change::None) vacate(entry);
    }
    entry.boundsPending = true;
    entry.missingReported = false;
    if (!entry.desc || entry.desc->name != desc.name) _order.clear();
    entry.desc = desc;
    entry.names = namesOf(desc);
    note(changed, id, entry, change);
}

void ObjectTable::setInstances(ObjectId id, const InstancesDesc& desc, ChangedSet& changed) {
    static const InstancesDesc once{{glm::mat4x3(1.f)}, {}, {}, {}, {}};
    Entry& entry = _entries[id];
    if (!complete(desc.motion, desc.transforms.size())) {
        InstancesDesc still = desc;
        still.motion = {};
        _device.messages()(Severity::Warning, entry.desc ? entry.desc->name : "",
                           "the motion of its instances is not complete; they stand still");
        return setInstances(id, still, changed);
    }
    const std::vector<InstanceChange> changes =
        changedInstances(entry.instances ? *entry.instances : once, desc);
    if (changes.empty()) return;
    const bool known = entry.desc && !entry.fresh; // that the object is new says it all
    for (size_t i = 0; i < changes.size() && known; ++i) {
        note(changed, id, entry, changes[i].change, changes[i].instance);
        if (changes[i].change != Change::Added) vacate(entry, changes[i].instance);
    }
    entry.instances = desc;
    entry.transformsPending = true;
}

void ObjectTable::removeObject(ObjectId id, ChangedSet& changed) {
    const auto found = _entries.find(id);
    if (found == _entries.end()) return;
    vacate(found->second);
    note(changed, id, found->second, Change::Removed);
    if (!found->second.splats.empty()) ++_splatRevision;
    _entries.erase(found);
    _order.clear();
}

void ObjectTable::geometryChanged(GeometryId geometry, Change change, ChangedSet& changed) {
    for (auto& [id, entry] : _entries) {
        if (!entry.desc || entry.desc->geometry != geometry) continue;
        entry.boundsPending = true;
        entry.missingReported = false;
        if (entry.fresh) continue;
        note(changed, id, entry, change == Change::Primvar ? Change::Primvar : Change::Geometry);
        vacate(entry);
    }
}

void ObjectTable::reportMissing(Entry& entry, const char* what) {
    if (entry.missingReported) return;
    entry.missingReported = true;
    _device.messages()(Severity::Warning, entry.desc->name,
                       std::string(what) + " not in the scene; the object is not rendered");
}

const Geometry* ObjectTable::shownGeometry(Entry& entry, const GeometryTable& geometries) {
    if (!entry.desc || !entry.desc->visible || entry.desc->geometry == GeometryId::None) return nullptr;
    const Geometry* geometry = geometries.find(entry.desc->geometry);
    if (!geometry) reportMissing(entry, "its geometry is");
    return geometry && !geometry->mesh->empty() ? geometry : nullptr;
}

void ObjectTable::findUsable(Entry& entry) {
    if (!entry.instances) {
        entry.usable.assign(1, 0);
        return;
    }
    const std::vector<glm::mat4x3>& transforms = entry.instances->transforms;
    entry.usable.clear();
    for (uint32_t i = 0; i < transforms.size(); ++i)
        if (canBeRendered(transforms[i])) entry.usable.push_back(i);
    const size_t skipped = transforms.size() - entry.usable.size();
    if (skipped == 0) return;
    _device.messages()(
        Severity::Warning, entry.desc->name,
        std::to_string(skipped) + " of " + std::to_string(transforms.size()) +
            " instances have a transform that is not finite or has no volume; they are not rendered");
}

ObjectTable::Placement ObjectTable::place(Entry& entry, const Geometry* geometry,
                                          const MaterialTable* materials, uint32_t first,
                                          std::vector<uint32_t>& materialIndices) {
    Placement placement;
    placement.first = first;
    placement.firstMaterial = uint32_t(materialIndices.size());
    if (entry.desc && (geometry || entry.desc->volume != VolumeId::None))
        placement.categories = _categories.set(entry.desc->categories);
    if (!geometry) return placement;
    placement.count = uint32_t(entry.usable.size());
    placement.geometry = geometry->slot;
    placement.materialCount = geometry->slotCount;
    placement.primId = entry.desc->primId;
    placement.flags = cullFlags(styleOf(*entry.desc), geometry->mesh->doubleSided);
    const bool fallbackNonOpaque =
        geometry->translucent || (entry.instances && isTranslucent(entry.instances->primvars));
    for (uint32_t slot = 0; slot < geometry->slotCount; ++slot) {
        const bool bound = materials && slot < entry.desc->materials.size();
        const MaterialId id = bound ? entry.desc->materials[slot] : MaterialId::None;
        const uint32_t index = bound ? materials->index(id) : MaterialTable::Fallback;
        materialIndices.push_back(index);
        if (index == MaterialTable::Fallback ? fallbackNonOpaque : materials->nonOpaque(id))
            placement.flags |= gpu::INSTANCE_NON_OPAQUE;
    }
    return placement;
}

uint32_t ObjectTable::categoriesOf(const Entry& entry, uint32_t instance) {
    const bool own = entry.instances && instance < entry.instances->categories.size() &&
                     !entry.instances->categories[instance].empty();
    if (!own) return entry.placed.categories;
    std::vector<std::string> names = entry.instances->categories[instance];
    names.insert(names.end(), entry.desc->categories.begin(), entry.desc->categories.end());
    return _categories.set(std::move(names));
}

void ObjectTable::writeRecords(ObjectId id, Entry& entry) {
    const Placement& placed = entry.placed;
    for (uint32_t i = 0; i < placed.count; ++i) {
        const uint32_t source = entry.usable[i];
        const glm::mat4x3 transform =
            entry.instances ? entry.instances->transforms[source] : glm::mat4x3(1.f);
        const bool hasIds = entry.instances && source < entry.instances->instanceIds.size();
        gpu::InstanceRecord& record = _records[placed.first + i];
        record.objectToWorld = transform;
        record.worldToObject = glm::mat4x3(inverseOf(transform));
        record.geometry = placed.geometry;
        record.firstMaterial = placed.firstMaterial;
        record.materialCount = placed.materialCount;
        record.flags = placed.flags | (mirrors(transform) ? gpu::INSTANCE_MIRRORED : 0);
        record.primId = placed.primId;
        record.instanceId = hasIds ? entry.instances->instanceIds[source] : int(source);
        record.object = uint32_t(id);
        record.objectInstance = source;
        record.categories = categoriesOf(entry, source);
        record.firstKey = placed.firstKey + i * placed.keyCount;
        record.keyCount = placed.keyCount;
        record.primvarCount = entry.primvarCount;
        record.primvars =
            entry.primvarCount ? entry.primvarTable + i * entry.primvarCount * sizeof(gpu::PrimvarRecord) : 0;
    }
}

/// The committed box of one instance or of all; empty if it is not rendered.
WorldBox ObjectTable::instanceBox(const Entry& entry, uint32_t instance) const {
    if (placedCount(entry) == 0) return {};
    if (instance == ChangedElement::AllInstances) return entry.box;
    const auto found = std::lower_bound(entry.usable.begin(), entry.usable.end(), instance);
    const bool usable = found != entry.usable.end() && *found == instance;
    return usable ? placedBox(entry, uint32_t(found - entry.usable.begin())) : WorldBox();
}

void ObjectTable::vacate(const Entry& entry, uint32_t instance) {
    const WorldBox box = instanceBox(entry, instance);
    if (!box.empty()) _vacated.push_back(box);
}

template <class Visitor> void ObjectTable::forObjectsShowing(MaterialId material, Visitor&& visit) const {
    for (const auto& [object, entry] : _entries) {
        if (!entry.desc) continue;
        const std::vector<MaterialId>& materials = entry.desc->materials;
        if (std::find(materials.begin(), materials.end(), material) != materials.end()) visit(object, entry);
    }
}

void ObjectTable::addOccupied(const ChangedElement& element, std::vector<WorldBox>& regions) const {
    const auto add = [&](const WorldBox& box) {
        if (!box.empty()) regions.push_back(box);
    };
    if (const ObjectId* id = std::get_if<ObjectId>(&element.element)) {
        const auto found = _entries.find(*id);
        if (found == _entries.end()) return;
        // The index of a removed instance may be another's by now.
        if (element.change != Change::Removed) add(instanceBox(found->second, element.instance));
    } else if (const MaterialId* material = std::get_if<MaterialId>(&element.element)) {
        forObjectsShowing(*material, [&](ObjectId, const Entry& entry) { add(entry.box); });
    }
}

void ObjectTable::addKeys(const ChangedElement& element, std::vector<gpu::ElementKey>& keys) const {
    static_assert(ChangedElement::AllInstances == gpu::EVERY_INSTANCE);
    if (const ObjectId* id = std::get_if<ObjectId>(&element.element))
        keys.push_back({uint32_t(*id), element.instance});
    else if (const MaterialId* material = std::get_if<MaterialId>(&element.element))
        forObjectsShowing(*material, [&](ObjectId object, const Entry&) {
            keys.push_back({uint32_t(object), gpu::EVERY_INSTANCE});
        });
}

void ObjectTable::updateBox(Entry& entry) const {
    entry.box = {};
    for (uint32_t i = 0; i < placedCount(entry); ++i)
        entry.box.add(placedBox(entry, i));
}

const std::vector<ObjectId>& ObjectTable::order() {
    if (_order.size() == _entries.size()) return _order;
    std::vector<std::pair<std::string, ObjectId>> named;
    for (const auto& [id, entry] : _entries)
        named.emplace_back(entry.desc ? entry.desc->name : std::string(), id);
    std::sort(named.begin(), named.end());
    _order.clear();
    for (const auto& [name, id] : named)
        _order.push_back(id);
    return _order;
}

bool ObjectTable::commit(const GeometryTable& geometries, const SplatTable& splats,
                         const VolumeTable& volumes, const MaterialTable* materials) {
    _tracedChanged = false;
    std::vector<uint32_t> materialIndices;
    std::vector<std::pair<ObjectId, Entry*>> rewritten;
    uint32_t total = 0, keys = 0;
    for (const ObjectId id : order()) {
        Entry& entry = _entries.at(id);
        entry.fresh = false;
        const SplatSet* set = shownSplats(entry, splats);
        const VolumeEntry* volume = set ? nullptr : shownVolume(entry, volumes);
        const Geometry* geometry = set || volume ? nullptr : shownGeometry(entry, geometries);
        const bool transformsChanged = (geometry || set || volume) && entry.transformsPending;
        if (transformsChanged) {
            findUsable(entry);
            findKeys(entry);
            uploadPrimvars(entry);
            entry.transformsPending = false;
        }
        placeSplats(entry, set, transformsChanged);
        Placement placement = place(entry, geometry, materials, total, materialIndices);
        if (placement.count > 0 && entry.keyCount > 0) {
            placement.firstKey = keys;
            placement.keyCount = entry.keyCount;
            keys += placement.count * placement.keyCount;
        }
        if ((transformsChanged && geometry) || !(placement == entry.placed))
            rewritten.push_back({id, &entry});
        entry.placed = placement;
        placeVolumes(id, entry, volume, transformsChanged);
        total += placement.count;
    }

    const bool resized = total != _records.size();
    _records.resize(total);
    for (auto& [id, entry] : rewritten) {
        writeRecords(id, *entry);
        entry->boundsPending |= entry->placed.count > 0; // placeSplats() has seen to splats
    }
    uploadRecords(rewritten);
    if (resized || !rewritten.empty()) uploadKeys();
    if (materialIndices != _materialIndices) {
        _materialIndices = std::move(materialIndices);
        _materialTable.reserve(_device, _materialIndices.size() * sizeof(uint32_t), "Instance tables");
        _device.upload(_materialTable.buffer(), _materialIndices.data(),
                       _materialIndices.size() * sizeof(uint32_t));
    }
    if (_keepsNames) uploadNames(materials);
    summarise(geometries);
    return resized || !rewritten.empty();
}

void ObjectTable::uploadRecords(const std::vector<std::pair<ObjectId, Entry*>>& rewritten) {
    constexpr uint64_t Stride = sizeof(gpu::InstanceRecord);
    size_t begin = _records.size(), end = 0;
    for (const auto& [id, entry] : rewritten) {
        begin = std::min<size_t>(begin, entry->placed.first);
        end = std::max<size_t>(end, entry->placed.first + entry->placed.count);
    }
    if (_recordTable.reserve(_device, _records.size() * Stride, "Instance tables"))
        begin = 0, end = _records.size();
    if (begin < end)
        _device.upload(_recordTable.buffer(), &_records[begin], (end - begin) * Stride, begin * Stride);
}

void ObjectTable::summarise(const GeometryTable& geometries) {
    _boundsMin = glm::vec3(std::numeric_limits<float>::max());
    _boundsMax = -_boundsMin;
    _nonOpaque = false;
    for (auto& [id, entry] : _entries) {
        if (entry.placed.count == 0 && entry.volumes.empty()) continue;
        if (entry.boundsPending && entry.placed.count > 0) {
            const TriangleMesh& mesh = *geometries.find(entry.desc->geometry)->mesh;
            entry.meshBox = {mesh.boundsMin, mesh.boundsMax};
            updateBox(entry);
        }
        entry.boundsPending = false;
        _boundsMin = glm::min(_boundsMin, entry.box.min);
        _boundsMax = glm::max(_boundsMax, entry.box.max);
        _nonOpaque |= (entry.placed.flags & gpu::INSTANCE_NON_OPAQUE) != 0;
    }
    if (_boundsMin.x > _boundsMax.x) _boundsMin = _boundsMax = glm::vec3(0.f);
}

void ObjectTable::describe(gpu::SceneRecord& scene) const {
    scene.instances = _recordTable.address();
    scene.instanceCount = uint32_t(_records.size());
    scene.motionKeys = _keyTable.address();
    scene.materialIndices = _materialTable.address();
    scene.slotNames = _keepsNames ? _slotNameTable.address() : 0;
    scene.boundsMin = _boundsMin;
    scene.boundsMax = _boundsMax;
    if (_nonOpaque) scene.flags |= gpu::SCENE_HAS_NON_OPAQUE;
}

} // namespace hipr
