#include "renderer/scene/volume_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/constants.hpp>

#include "renderer/scene/buffer_pack.h"
#include "renderer/shading/blackbody.h"

namespace hipr {
namespace {

/// Needles of a phase function cannot be sampled well.
constexpr float MostAnisotropy = 0.99f;
/// Of Stefan and Boltzmann, in MW m^-2 K^-4.
constexpr double RadiantPower = 5.670374419e-14;

bool equal(const FieldGrid& a, const FieldGrid& b) {
    return a.name == b.name && a.channels == b.channels && a.first == b.first && a.bricks == b.bricks &&
           a.latticeToObject == b.latticeToObject && a.index == b.index && a.largest == b.largest &&
           a.values == b.values;
}

glm::dmat4 square(const glm::dmat4x3& m) {
    return {glm::dvec4(m[0], 0), glm::dvec4(m[1], 0), glm::dvec4(m[2], 0), glm::dvec4(m[3], 1)};
}

/// The box around what a matrix makes of a box.
WorldBox transformed(const WorldBox& box, const glm::dmat4x3& m) {
    if (box.empty()) return {};
    const glm::dvec3 centre = 0.5 * (glm::dvec3(box.min) + glm::dvec3(box.max)),
                     half = glm::dvec3(box.max) - centre;
    const glm::dvec3 c = m * glm::dvec4(centre, 1);
    const glm::dvec3 h = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
    return {glm::vec3(c - h), glm::vec3(c + h)};
}

/// Of the lattice points of a grid, in object space.
WorldBox boxOf(const FieldGrid& grid) {
    if (grid.index.empty()) return {};
    const glm::vec3 lo(grid.first), size(grid.bricks * uint32_t(FieldGrid::Cells));
    return transformed({lo, lo + size}, grid.latticeToObject);
}

/// A number that tells volumes apart whatever their ids: of their names and of which instance it is.
uint32_t seedOf(const std::string& name, uint32_t instance) {
    uint32_t hash = 0x811c9dc5u ^ instance * 0x9e3779b9u; // FNV-1a
    for (const char c : name)
        hash = (hash ^ uint8_t(c)) * 0x01000193u;
    return hash;
}

} // namespace

Change VolumeTable::setField(FieldId id, std::shared_ptr<const FieldGrid> grid) {
    const auto [it, added] = _fields.try_emplace(id);
    Field& field = it->second;
    if (!added && !field.refused && (field.grid == grid || equal(*field.grid, *grid))) return Change::None;
    field = {std::move(grid), nullptr, false};
    fieldChanged(id);
    return added ? Change::Added : Change::Geometry;
}

bool VolumeTable::removeField(FieldId id) {
    if (_fields.erase(id) == 0) return false;
    fieldChanged(id);
    return true;
}

Change VolumeTable::setVolume(VolumeId id, const VolumeDesc& desc) {
    const auto [it, added] = _volumes.try_emplace(id);
    VolumeEntry& entry = it->second;
    if (!added && entry.desc == desc) return Change::None;
    VolumeDesc restyled = entry.desc;
    restyled.look = desc.look;
    const Change change = added ? Change::Added : restyled == desc ? Change::Material : Change::Geometry;
    entry.desc = desc;
    entry.revision = ++_revisions;
    updateBox(entry);
    _changed = true;
    return change;
}

bool VolumeTable::removeVolume(VolumeId id) {
    const bool found = _volumes.erase(id) > 0;
    _changed |= found;
    return found;
}

Change VolumeTable::setLook(MaterialId id, const VolumeLook& look) {
    const auto [it, added] = _looks.try_emplace(id, look);
    if (!added && it->second == look) return Change::None;
    it->second = look;
    _changed = true;
    return added ? Change::Added : Change::Material;
}

bool VolumeTable::removeLook(MaterialId id) {
    const bool found = _looks.erase(id) > 0;
    _changed |= found;
    return found;
}

const VolumeEntry* VolumeTable::find(VolumeId id) const {
    const auto it = _volumes.find(id);
    return it == _volumes.end() ? nullptr : &it->second;
}

std::vector<VolumeId> VolumeTable::showing(FieldId field) const {
    std::vector<VolumeId> found;
    for (const auto& [id, entry] : _volumes) {
        const VolumeDesc& desc = entry.desc;
        if (desc.density == field || desc.emission == field || desc.temperature == field ||
            desc.color == field)
            found.push_back(id);
    }
    return found;
}

void VolumeTable::fieldChanged(FieldId field) {
    _changed = true;
    for (const VolumeId id : showing(field)) {
        VolumeEntry& entry = _volumes.at(id);
        entry.revision = ++_revisions;
        updateBox(entry);
    }
}

void VolumeTable::updateBox(VolumeEntry& entry) const {
    entry.box = {};
    // What scatters and what glows. Where there is neither, the other fields do nothing.
    for (const FieldId id : {entry.desc.density, entry.desc.emission, entry.desc.temperature})
        if (const Field* field = shownField(id)) entry.box.add(boxOf(*field->grid));
}

/// Null: there is nothing in it, or no memory for it.
const VolumeTable::Field* VolumeTable::shownField(FieldId id) const {
    const auto it = _fields.find(id);
    const bool shown = it != _fields.end() && !it->second.refused && !it->second.grid->index.empty();
    return shown ? &it->second : nullptr;
}

void VolumeTable::reportTriples(VolumeEntry& entry) {
    if (entry.checked == entry.revision) return;
    entry.checked = entry.revision;
    const std::pair<const char*, FieldId> numbers[] = {{"density", entry.desc.density},
                                                       {"temperature", entry.desc.temperature}};
    for (const auto& [role, id] : numbers) {
        const Field* field = shownField(id);
        if (field && field->grid->channels > 1)
            _device.messages()(Severity::Warning, entry.desc.name,
                               "its field '" + std::string(role) +
                                   "' has triples of numbers; only the first counts");
    }
}

void VolumeTable::upload(FieldId id, Field& field) {
    const FieldGrid& grid = *field.grid;
    if (field.device || field.refused || grid.index.empty()) return;
    std::weak_ptr<DeviceGrid>& shared = _uploaded[&grid];
    field.device = shared.lock();
    if (field.device) return;
    try {
        shared = field.device = toDevice(grid);
    } catch (const OutOfMemory& e) { // one field too large must not be the end of the picture
        field.refused = true;
        for (const VolumeId volume : showing(id))
            _device.messages()(Severity::Error, _volumes.at(volume).desc.name,
                               std::string(e.what()) + "; it has no " + grid.name);
    }
}

std::shared_ptr<VolumeTable::DeviceGrid> VolumeTable::toDevice(const FieldGrid& grid) {
    if (grid.values.size() > std::numeric_limits<uint32_t>::max())
        throw OutOfMemory("kernels cannot number " + std::to_string(grid.values.size()) + " values");
    std::vector<gpu::BrickEntry> entries(grid.index.size());
    for (size_t i = 0; i < entries.size(); ++i)
        entries[i] = {grid.index[i], grid.largest[i]};
    auto device = std::make_shared<DeviceGrid>();
    const uint64_t entryBytes = (entries.size() * sizeof(gpu::BrickEntry) + 15) & ~uint64_t(15);
    const uint64_t valueBytes = grid.values.size() * sizeof(float);
    device->buffer = _device.createBuffer(entryBytes + valueBytes, MemoryUse::Device, "Volumes");
    _device.upload(device->buffer, entries.data(), entries.size() * sizeof(gpu::BrickEntry));
    _device.upload(device->buffer, grid.values.data(), valueBytes, entryBytes);
    device->entries = device->buffer.address();
    device->values = device->entries + entryBytes;
    return device;
}

void VolumeTable::uploadBlackbody() {
    if (_blackbody) return;
    std::vector<glm::vec3> table(gpu::BLACKBODY_STEPS);
    for (uint32_t i = 0; i < gpu::BLACKBODY_STEPS; ++i) {
        const double kelvin = double(gpu::BLACKBODY_LARGEST) * i / (gpu::BLACKBODY_STEPS - 1);
        table[i] = blackbodyColor(float(kelvin)) *
                   float(RadiantPower / glm::pi<double>() * kelvin * kelvin * kelvin * kelvin);
    }
    _blackbody = _device.createFrom(table.data(), table.size(), "Volumes");
}

gpu::FieldRecord VolumeTable::fieldRecord(FieldId id, const glm::mat4x3& toPlaced) const {
    gpu::FieldRecord record{};
    const Field* field = shownField(id);
    if (!field) return record;
    glm::dmat4 m = glm::inverse(square(glm::dmat4x3(toPlaced)) * square(field->grid->latticeToObject));
    m[3] -= glm::dvec4(glm::dvec3(field->grid->first), 0);
    record.placedToCells = glm::mat4x3(m);
    record.entries = field->device->entries;
    record.values = field->device->values;
    record.bricks = field->grid->bricks;
    record.channels = field->grid->channels;
    return record;
}

void VolumeTable::setGlow(gpu::VolumeRecord& record, const VolumeDesc& desc, const VolumeLook& look,
                          const glm::mat4x3& toPlaced) const {
    if (look.emission == glm::vec3(0.f)) return;
    record.temperature = fieldRecord(desc.temperature, toPlaced);
    FieldId source = FieldId::None;
    if (shownField(desc.emission))
        source = desc.emission;
    else if (look.emissionByDensity)
        source = desc.density;
    record.flags = source != FieldId::None ? gpu::VOLUME_EMISSION_SCALED : 0;
    record.glow = fieldRecord(source != FieldId::None ? source : desc.temperature, toPlaced);
}

gpu::VolumeRecord VolumeTable::record(const VolumePlacement& placement) const {
    const VolumeDesc& desc = _volumes.at(placement.volume).desc;
    const auto bound = _looks.find(placement.material);
    const VolumeLook& look = bound == _looks.end() ? desc.look : bound->second;
    gpu::VolumeRecord record{};
    record.boxMin = placement.box.min;
    record.boxMax = placement.box.max;
    record.scattering = glm::max(look.scattering, 0.f);
    record.extinction = record.scattering + glm::max(look.absorption, 0.f);
    record.densest = std::max({record.extinction.x, record.extinction.y, record.extinction.z});
    // Kernels bring rays to the object space of what moves.
    const glm::mat4x3 toPlaced = placement.keys.empty() ? placement.objectToWorld : glm::mat4x3(1.f);
    if (record.densest > 0.f) record.density = fieldRecord(desc.density, toPlaced);
    record.color = fieldRecord(desc.color, toPlaced);
    record.anisotropy = std::clamp(look.anisotropy, -MostAnisotropy, MostAnisotropy);
    record.emission = glm::max(look.emission, 0.f);
    record.temperatureScale = std::max(look.temperatureScale, 0.f);
    setGlow(record, desc, look, toPlaced);
    record.seed = seedOf(desc.name, placement.instance);
    record.categories = placement.categories;
    record.primId = placement.primId;
    record.instanceId = placement.instanceId;
    record.object = placement.object;
    record.objectInstance = placement.instance;
    return record;
}

/// After the records are made, which learn where their keys are.
void VolumeTable::uploadKeys() {
    std::vector<glm::mat4x3> keys;
    for (const VolumePlacement& placement : _placements)
        keys.insert(keys.end(), placement.keys.begin(), placement.keys.end());
    if (keys.empty()) return;
    _keyTable = _device.createFrom(keys.data(), keys.size(), "Volumes");
    uint64_t address = _keyTable.address();
    for (size_t i = 0; i < _records.size(); ++i) {
        _records[i].keyCount = uint32_t(_placements[i].keys.size());
        _records[i].keys = address;
        address += _records[i].keyCount * sizeof(glm::mat4x3);
    }
}

void VolumeTable::commit(std::vector<VolumePlacement> placements) {
    if (!_changed && placements == _placements) return;
    _changed = false;
    _placements = std::move(placements);
    for (auto& [id, field] : _fields)
        upload(id, field);
    for (auto it = _uploaded.begin(); it != _uploaded.end();)
        it = it->second.expired() ? _uploaded.erase(it) : std::next(it);
    for (auto& [id, entry] : _volumes)
        reportTriples(entry);
    _records.clear();
    for (const VolumePlacement& placement : _placements)
        _records.push_back(record(placement));
    if (_records.empty()) return;
    uploadBlackbody();
    uploadKeys();
    _table = _device.createFrom(_records.data(), _records.size(), "Volumes");
}

void VolumeTable::describe(gpu::SceneRecord& scene) const {
    if (_records.empty()) return;
    scene.volumes = _table.address();
    scene.blackbody = _blackbody.address();
    scene.volumeCount = uint32_t(_records.size());
    scene.flags |= gpu::SCENE_HAS_VOLUMES;
}

uint64_t VolumeTable::hostBytes() const {
    std::set<const FieldGrid*> grids;
    uint64_t bytes = 0;
    for (const auto& [id, field] : _fields)
        if (grids.insert(field.grid.get()).second)
            bytes += field.grid->values.size() * sizeof(float) +
                     field.grid->index.size() * (sizeof(uint32_t) + sizeof(float));
    return bytes;
}

} // namespace hipr
