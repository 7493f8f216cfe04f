// The part of the object table that is about splats.
#include "renderer/scene/object_table.h"

namespace hipr {

void ObjectTable::splatsChanged(SplatsId splats, ChangedSet& changed) {
    for (auto& [id, entry] : _entries) {
        if (!entry.desc || entry.desc->splats != splats) continue;
        entry.boundsPending = true;
        entry.missingReported = false;
        if (entry.fresh) continue;
        note(changed, id, entry, Change::Geometry);
        vacate(entry);
    }
}

const SplatSet* ObjectTable::shownSplats(Entry& entry, const SplatTable& splats) {
    if (!entry.desc || !entry.desc->visible || entry.desc->splats == SplatsId::None) return nullptr;
    const SplatSet* set = splats.find(entry.desc->splats);
    if (!set) reportMissing(entry, "its splats are");
    return set && set->cloud->size() > 0 ? set : nullptr;
}

/// Does nothing for objects without splats, and for those whose splats are as they were.
void ObjectTable::placeSplats(Entry& entry, const SplatSet* shown, bool transformsChanged) {
    const bool same = shown ? !transformsChanged && !entry.boundsPending && entry.splatSet == shown->revision
                            : entry.splats.empty();
    if (same) return;
    ++_splatRevision;
    entry.splats.clear();
    entry.splatSet = shown ? shown->revision : 0;
    if (!shown) return;
    entry.boundsPending = false;
    for (const uint32_t source : entry.usable) {
        const auto keys = entry.keys.begin() + ptrdiff_t(entry.splats.size() * entry.keyCount);
        const bool hasIds = entry.instances && source < entry.instances->instanceIds.size();
        entry.splats.push_back(
            {entry.desc->splats, entry.instances ? entry.instances->transforms[source] : glm::mat4x3(1.f),
             entry.desc->primId, hasIds ? entry.instances->instanceIds[source] : int(source),
             std::vector<glm::mat4x3>(keys, keys + entry.keyCount)});
    }
    entry.meshBox = shown->box;
    updateBox(entry);
}

std::vector<SplatPlacement> ObjectTable::splats() const {
    std::vector<SplatPlacement> all;
    for (const ObjectId id : _order) {
        const Entry& entry = _entries.at(id);
        all.insert(all.end(), entry.splats.begin(), entry.splats.end());
    }
    return all;
}

} // namespace hipr
