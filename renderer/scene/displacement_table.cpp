#include "renderer/scene/displacement_table.h"

#include <algorithm>

namespace hipr {

bool DisplacementTable::setGeometry(GeometryId id, const std::shared_ptr<const TriangleMesh>& mesh) {
    _stale = true;
    const auto found = _displaced.find(id);
    if (found == _displaced.end()) return false;
    if (found->second.base != mesh) _replaced.insert(id);
    found->second.base = mesh;
    return true;
}

void DisplacementTable::removeGeometry(GeometryId id) {
    _displaced.erase(id);
    _replaced.erase(id);
}

void DisplacementTable::setMaterial(MaterialId id, const MaterialDesc& desc) {
    if (desc.displacement.none()) return removeMaterial(id);
    std::shared_ptr<const Displacer>& displacer = _materials[id];
    if (displacer && displacer->description() == desc.displacement) return;
    displacer = std::make_shared<Displacer>(
        desc.displacement, [&](const TextureDesc& wanted) { return texture(wanted, desc.name); });
    _stale = true;
}

void DisplacementTable::removeMaterial(MaterialId id) {
    _stale |= _materials.erase(id) > 0;
}

void DisplacementTable::setEnabled(bool enabled) {
    _stale |= enabled != _enabled;
    _enabled = enabled;
}

std::shared_ptr<const HostTexture> DisplacementTable::texture(const TextureDesc& desc,
                                                              const std::string& subject) {
    std::weak_ptr<const HostTexture>& kept = _textures[{desc.path, desc.colorSpace}];
    std::shared_ptr<const HostTexture> found = kept.lock();
    if (!found) {
        found = std::make_shared<HostTexture>(desc, _assets, *_color, _messages, subject);
        kept = found;
    }
    return found;
}

DisplacementTable::Slots DisplacementTable::slotsOf(const ObjectDesc& object) const {
    Slots slots;
    for (size_t i = 0; i < object.materials.size(); ++i) {
        const auto found = _materials.find(object.materials[i]);
        if (found == _materials.end()) continue;
        slots.resize(i + 1);
        slots[i] = found->second;
    }
    return slots;
}

std::map<GeometryId, DisplacementTable::Slots> DisplacementTable::wanted(const ObjectTable& objects) const {
    std::map<GeometryId, Slots> result;
    if (!_enabled || _materials.empty()) return result;
    objects.forObjects([&](const ObjectDesc& object) {
        if (object.geometry != GeometryId::None) result.emplace(object.geometry, slotsOf(object));
    });
    return result;
}

void DisplacementTable::update(GeometryTable& geometries, ObjectTable& objects, ChangedSet& changed) {
    if (!_stale) return;
    _stale = false;
    if (_materials.empty() && _displaced.empty()) return;
    const auto show = [&](GeometryId id, std::shared_ptr<const TriangleMesh> mesh) {
        const Change change = geometries.set(id, std::move(mesh));
        if (change != Change::None) objects.geometryChanged(id, change, changed);
    };
    const std::map<GeometryId, Slots> wanted = this->wanted(objects);
    for (auto it = _displaced.begin(); it != _displaced.end();) {
        const auto found = wanted.find(it->first);
        if (found != wanted.end() && !found->second.empty()) {
            ++it;
            continue;
        }
        show(it->first, it->second.base);
        _replaced.erase(it->first);
        it = _displaced.erase(it);
    }
    for (const auto& [id, slots] : wanted) {
        const Geometry* geometry = geometries.find(id);
        if (slots.empty() || !geometry) continue;
        const auto [entry, added] = _displaced.try_emplace(id, Entry{geometry->mesh, slots});
        if (!added && entry->second.slots == slots && !_replaced.count(id)) continue;
        entry->second.slots = slots;
        const auto& base = entry->second.base; // round segments have no surface to move
        show(id, base->segments.empty() ? displacedMesh(*base, slots) : base);
    }
    _replaced.clear();
    for (auto it = _textures.begin(); it != _textures.end();)
        it = it->second.expired() ? _textures.erase(it) : std::next(it);
}

uint64_t DisplacementTable::hostBytes() const {
    uint64_t bytes = 0;
    for (const auto& [id, entry] : _displaced)
        bytes += hostBytesOf(*entry.base);
    return bytes;
}

} // namespace hipr
