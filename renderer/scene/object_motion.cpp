// The part of the object table that is about instances that move while the shutter is open.
#include <algorithm>

#include "renderer/scene/motion.h"
#include "renderer/scene/object_table.h"
#include "renderer/scene/placements.h"

namespace hipr {
namespace {

/// The motion of one instance; none where it cannot be rendered at some time.
std::optional<PlacementMotion> motionOf(const InstanceMotion& motion, uint32_t instance) {
    std::vector<glm::dmat4x3> placements;
    for (const std::vector<glm::mat4x3>& transforms : motion.transforms) {
        const glm::mat4x3& placement = transforms[instance];
        if (!canBeRendered(placement) || mirrors(placement) != mirrors(motion.transforms[0][instance]))
            return {};
        placements.emplace_back(placement);
    }
    return PlacementMotion(motion.times, placements);
}

WorldBox boxOf(const WorldBox& box, const glm::mat4x3& m) {
    const glm::vec3 centre = 0.5f * (box.min + box.max), half = 0.5f * (box.max - box.min);
    const glm::vec3 c = m * glm::vec4(centre, 1.f);
    const glm::vec3 h = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
    return {c - h, c + h};
}

} // namespace

void ObjectTable::setShutter(const Shutter& shutter) {
    if (shutter == _shutter) return;
    _shutter = shutter;
    for (auto& [id, entry] : _entries)
        if (entry.instances && !entry.instances->motion.times.empty()) entry.transformsPending = true;
}

bool ObjectTable::anyMotion() const {
    return std::any_of(_entries.begin(), _entries.end(), [](const auto& e) {
        const bool traced = !e.second.desc || e.second.desc->splats == SplatsId::None;
        return traced && e.second.instances && e.second.instances->motion.times.size() > 1;
    });
}

void ObjectTable::findKeys(Entry& entry) {
    entry.keys.clear();
    entry.keyCount = 0;
    if (!entry.instances || !_shutter.blurs() || entry.instances->motion.times.size() < 2) return;
    const InstanceMotion& motion = entry.instances->motion;
    std::vector<std::optional<PlacementMotion>> motions;
    size_t broken = 0;
    for (const uint32_t instance : entry.usable) {
        motions.push_back(motionOf(motion, instance));
        broken += !motions.back();
        if (motions.back() && motions.back()->moves())
            entry.keyCount = std::max(entry.keyCount, motions.back()->keys(_shutter));
    }
    if (broken > 0)
        _device.messages()(Severity::Warning, entry.desc->name,
                           std::to_string(broken) + " of " + std::to_string(motions.size()) +
                               " instances have no volume or turn inside out while the shutter is open; "
                               "they stand still");
    for (size_t i = 0; i < motions.size(); ++i)
        for (uint32_t k = 0; k < entry.keyCount; ++k)
            entry.keys.push_back(motions[i]
                                     ? glm::mat4x3(motions[i]->at(keyFrame(_shutter, k, entry.keyCount)))
                                     : entry.instances->transforms[entry.usable[i]]);
}

void ObjectTable::uploadKeys() {
    _keys.clear();
    for (const ObjectId id : _order) {
        const Entry& entry = _entries.at(id);
        if (entry.placed.keyCount > 0) _keys.insert(_keys.end(), entry.keys.begin(), entry.keys.end());
    }
    if (_keys.empty()) return;
    _keyTable.reserve(_device, _keys.size() * sizeof(glm::mat4x3), "Instance tables");
    _device.upload(_keyTable.buffer(), _keys.data(), _keys.size() * sizeof(glm::mat4x3));
}

/// The world box of a committed instance at all times, counted among those that can be rendered.
WorldBox ObjectTable::placedBox(const Entry& entry, uint32_t i) const {
    const uint32_t keys = entry.volumes.empty() ? entry.placed.keyCount : entry.keyCount;
    if (keys == 0) return boxOf(entry.meshBox, placedTransform(entry, i));
    WorldBox box;
    for (uint32_t k = 0; k < keys; ++k)
        box.add(boxOf(entry.meshBox, entry.keys[i * keys + k]));
    return box;
}

} // namespace hipr
