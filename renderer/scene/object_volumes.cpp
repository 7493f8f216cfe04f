// The part of the object table that is about volumes, and about placements of any kind.
#include "renderer/scene/object_table.h"

namespace hipr {

void ObjectTable::volumeChanged(VolumeId volume, Change change, ChangedSet& changed) {
    for (auto& [id, entry] : _entries) {
        if (!entry.desc || entry.desc->volume != volume) continue;
        entry.boundsPending = true;
        entry.missingReported = false;
        if (entry.fresh) continue;
        note(changed, id, entry, change == Change::Material ? Change::Material : Change::Geometry);
        vacate(entry);
    }
}

const VolumeEntry* ObjectTable::shownVolume(Entry& entry, const VolumeTable& volumes) {
    if (!entry.desc || !entry.desc->visible || entry.desc->volume == VolumeId::None) return nullptr;
    const VolumeEntry* volume = volumes.find(entry.desc->volume);
    if (!volume) reportMissing(entry, "its volume is");
    return volume && !volume->box.empty() ? volume : nullptr;
}

/// Does nothing for objects without a volume, and for those whose volume is as it was. After `entry.placed`
/// is set.
void ObjectTable::placeVolumes(ObjectId id, Entry& entry, const VolumeEntry* shown, bool transformsChanged) {
    const bool same =
        shown ? !transformsChanged && !entry.boundsPending && entry.volumeRevision == shown->revision
              : entry.volumes.empty();
    if (same) return;
    entry.volumes.clear();
    entry.volumeRevision = shown ? shown->revision : 0;
    if (!shown) return;
    entry.boundsPending = false;
    const std::vector<MaterialId>& materials = entry.desc->materials;
    for (const uint32_t source : entry.usable) {
        const auto keys = entry.keys.begin() + ptrdiff_t(entry.volumes.size() * entry.keyCount);
        const bool hasIds = entry.instances && source < entry.instances->instanceIds.size();
        VolumePlacement placement;
        placement.volume = entry.desc->volume;
        placement.material = materials.empty() ? MaterialId::None : materials.front();
        if (entry.instances) placement.objectToWorld = entry.instances->transforms[source];
        placement.keys.assign(keys, keys + entry.keyCount);
        placement.object = uint32_t(id);
        placement.instance = source;
        placement.categories = categoriesOf(entry, source);
        placement.primId = entry.desc->primId;
        placement.instanceId = hasIds ? entry.instances->instanceIds[source] : int(source);
        entry.volumes.push_back(placement);
    }
    entry.meshBox = shown->box;
    updateBox(entry);
    for (uint32_t i = 0; i < entry.volumes.size(); ++i)
        entry.volumes[i].box = placedBox(entry, i);
}

const glm::mat4x3& ObjectTable::placedTransform(const Entry& entry, uint32_t i) const {
    if (!entry.splats.empty()) return entry.splats[i].objectToWorld;
    if (!entry.volumes.empty()) return entry.volumes[i].objectToWorld;
    return _records[entry.placed.first + i].objectToWorld;
}

std::vector<VolumePlacement> ObjectTable::volumes() const {
    std::vector<VolumePlacement> all;
    for (const ObjectId id : _order) {
        const Entry& entry = _entries.at(id);
        all.insert(all.end(), entry.volumes.begin(), entry.volumes.end());
    }
    return all;
}

} // namespace hipr
