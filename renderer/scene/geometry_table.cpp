#include "renderer/scene/geometry_table.h"

#include <algorithm>

#include "renderer/scene/motion.h"

namespace hipr {
namespace {

bool equalPrimvars(const TrianglePrimvar& a, const TrianglePrimvar& b) {
    return a.name == b.name && a.interpolation == b.interpolation && a.components == b.components &&
           a.values == b.values;
}

bool equalAttributes(const TriangleMesh& a, const TriangleMesh& b) {
    return a.triangleFace == b.triangleFace && a.triangleSlot == b.triangleSlot && a.normals == b.normals &&
           a.normalInterpolation == b.normalInterpolation && a.doubleSided == b.doubleSided &&
           a.name == b.name &&
           std::equal(a.primvars.begin(), a.primvars.end(), b.primvars.begin(), b.primvars.end(),
                      equalPrimvars);
}

bool hasTranslucency(const TriangleMesh& mesh) {
    for (const TrianglePrimvar& primvar : mesh.primvars)
        if (primvar.name == "displayOpacity")
            return std::any_of(primvar.values.begin(), primvar.values.end(), [](float v) { return v < 1.f; });
    return false;
}

} // namespace

uint64_t hostBytesOf(const TriangleMesh& mesh) {
    uint64_t bytes = mesh.positions.size() * sizeof(glm::vec3) + mesh.triangles.size() * sizeof(glm::uvec3) +
                     mesh.segments.size() * sizeof(uint32_t) + mesh.radii.size() * sizeof(float) +
                     mesh.triangleFace.size() * sizeof(uint32_t) +
                     mesh.triangleSlot.size() * sizeof(uint16_t) + mesh.normals.size() * sizeof(glm::vec3);
    for (const TrianglePrimvar& primvar : mesh.primvars)
        bytes += primvar.values.size() * sizeof(float);
    for (const MeshKey& key : mesh.motion)
        bytes += (key.positions.size() + key.normals.size()) * sizeof(glm::vec3);
    return bytes;
}

Change GeometryTable::set(GeometryId id, std::shared_ptr<const TriangleMesh> mesh) {
    auto [it, added] = _entries.try_emplace(id);
    Entry& entry = it->second;
    if (!added && entry.mesh == mesh) return Change::None;
    Change change = Change::Added;
    if (added) {
        if (_freeSlots.empty()) _freeSlots.push_back(_slotCount++);
        entry.slot = _freeSlots.back();
        _freeSlots.pop_back();
    } else {
        const bool sameShape = entry.mesh->positions == mesh->positions &&
                               entry.mesh->triangles == mesh->triangles &&
                               entry.mesh->segments == mesh->segments && entry.mesh->radii == mesh->radii &&
                               entry.mesh->motion == mesh->motion;
        if (sameShape && equalAttributes(*entry.mesh, *mesh)) {
            entry.mesh = std::move(mesh);
            return Change::None;
        }
        entry.shapePending |= !sameShape;
        change = sameShape ? Change::Primvar : Change::Geometry;
    }
    entry.mesh = std::move(mesh);
    entry.translucent = hasTranslucency(*entry.mesh);
    const std::vector<uint16_t>& slots = entry.mesh->triangleSlot;
    entry.slotCount = slots.empty() ? 1 : 1u + *std::max_element(slots.begin(), slots.end());
    entry.attributesPending = true;
    _recordsPending = true;
    return change;
}

bool GeometryTable::remove(GeometryId id) {
    auto it = _entries.find(id);
    if (it == _entries.end()) return false;
    // Traversals may read the buffer until they are told in commit(); the slot is free again after that.
    _removedSlots.push_back(it->second.slot);
    _retired.push_back(std::move(it->second.shape));
    _entries.erase(it);
    return true;
}

const Geometry* GeometryTable::find(GeometryId id) const {
    auto it = _entries.find(id);
    return it == _entries.end() ? nullptr : &it->second;
}

void GeometryTable::setShutter(const Shutter& shutter) {
    if (shutter == _shutter) return;
    _shutter = shutter;
    for (auto& [id, entry] : _entries)
        if (!entry.mesh->motion.empty())
            entry.shapePending = entry.attributesPending = _recordsPending = true;
}

bool GeometryTable::anySegments() const {
    return std::any_of(_entries.begin(), _entries.end(),
                       [](const auto& e) { return !e.second.mesh->segments.empty(); });
}

bool GeometryTable::anyMotion() const {
    return std::any_of(_entries.begin(), _entries.end(),
                       [](const auto& e) { return e.second.mesh->motion.size() > 1; });
}

void GeometryTable::resubmit() {
    for (auto& [id, entry] : _entries)
        entry.submitted = nullptr;
}

void GeometryTable::commit(Traversal& traversal) {
    for (uint32_t slot : _removedSlots) {
        traversal.setGeometry(slot, nullptr);
        _freeSlots.push_back(slot);
    }
    _removedSlots.clear();
    for (auto& [id, entry] : _entries) {
        if (entry.shapePending) entry.keys = meshKeys(*entry.mesh, _shutter);
        if (entry.attributesPending) uploadAttributes(entry);
        if (entry.shapePending) uploadShape(entry);
        if (entry.shapePending || !entry.submitted) submit(entry, traversal);
        entry.attributesPending = entry.shapePending = false;
    }
    _retired.clear();
    if (!_recordsPending) return;
    _recordsPending = false;
    std::vector<gpu::GeometryRecord> records(_slotCount);
    for (const auto& [id, entry] : _entries)
        records[entry.slot] = entry.record;
    _records.reserve(_device, records.size() * sizeof(gpu::GeometryRecord), "Geometry tables");
    _device.upload(_records.buffer(), records.data(), records.size() * sizeof(gpu::GeometryRecord));
}

void GeometryTable::uploadShape(Entry& entry) {
    const TriangleMesh& mesh = *entry.mesh;
    BufferPack pack;
    entry.keyPositions.clear();
    if (entry.keys > 1) entry.keyPositions = keyed(mesh, &MeshKey::positions, _shutter, entry.keys);
    const uint64_t positions = // host traversals read 4 bytes beyond the last vertex
        pack.add(entry.keys > 1 ? entry.keyPositions : mesh.positions, 16);
    const bool segments = !mesh.segments.empty();
    const uint64_t triangles = segments ? pack.add(mesh.segments) : pack.add(mesh.triangles);
    const uint64_t radii = pack.add(mesh.radii);
    _retired.push_back(std::move(entry.shape));
    entry.shape = _device.createBuffer(pack.bytes(), MemoryUse::Device, "Geometry");
    pack.upload(_device, entry.shape);
    entry.record.positions = entry.shape.address() + positions;
    entry.record.triangles = entry.shape.address() + triangles;
    entry.record.radii = segments ? entry.shape.address() + radii : 0;
    entry.record.vertexCount = uint32_t(mesh.positions.size());
    entry.record.triangleCount = mesh.primitiveCount();
    entry.record.keys = entry.keys;
    if (entry.shape.mapped()) entry.keyPositions = {};
}

void GeometryTable::uploadAttributes(Entry& entry) {
    const TriangleMesh& mesh = *entry.mesh;
    BufferPack pack;
    const uint64_t normals =
        pack.add(entry.keys > 1 ? keyed(mesh, &MeshKey::normals, _shutter, entry.keys) : mesh.normals);
    const uint64_t faces = pack.add(mesh.triangleFace);
    const uint64_t slots = pack.add(mesh.triangleSlot);
    std::vector<gpu::PrimvarRecord> primvars;
    for (const TrianglePrimvar& primvar : mesh.primvars)
        primvars.push_back({pack.add(primvar.values), _names.intern(primvar.name),
                            uint32_t(primvar.interpolation), primvar.components, 0});
    const uint64_t table = pack.reserve(primvars.size() * sizeof(gpu::PrimvarRecord));
    entry.attributes = _device.createBuffer(pack.bytes(), MemoryUse::Device, "Primvars");
    const VkDeviceAddress base = entry.attributes.address();
    for (gpu::PrimvarRecord& primvar : primvars)
        primvar.values += base;
    pack.write(table, primvars);
    pack.upload(_device, entry.attributes);

    entry.record.normals = mesh.normals.empty() ? 0 : base + normals;
    entry.record.triangleFace = base + faces;
    entry.record.triangleSlot = mesh.triangleSlot.empty() ? 0 : base + slots;
    entry.record.primvars = base + table;
    entry.record.primvarCount = uint32_t(primvars.size());
    entry.record.flags =
        (mesh.doubleSided ? gpu::GEOMETRY_DOUBLE_SIDED : 0) |
        (mesh.normalInterpolation == Interpolation::FaceVarying ? gpu::GEOMETRY_NORMALS_FACE_VARYING : 0);
}

void GeometryTable::submit(Entry& entry, Traversal& traversal) {
    const TriangleMesh& mesh = *entry.mesh;
    const bool sameTopology = entry.submitted && entry.submitted->triangles == mesh.triangles &&
                              entry.submitted->segments == mesh.segments &&
                              entry.submitted->positions.size() == mesh.positions.size() &&
                              entry.submittedKeys == entry.keys;
    // Where kernels and host share memory the traversal reads the same copy as they do.
    const void* own = entry.keys > 1 ? entry.keyPositions.data() : mesh.positions.data();
    const void* positions = entry.shape.mapped() ? entry.shape.mapped() : own;
    GeometryView view{static_cast<const glm::vec3*>(positions),
                      entry.record.vertexCount,
                      mesh.triangles.data(),
                      entry.record.triangleCount,
                      entry.record.positions,
                      entry.record.triangles,
                      sameTopology,
                      entry.keys,
                      mesh.segments.empty() ? nullptr : mesh.segments.data(),
                      mesh.radii.data()};
    traversal.setGeometry(entry.slot, mesh.empty() ? nullptr : &view);
    entry.submitted = entry.mesh;
    entry.submittedKeys = entry.keys;
}

uint64_t GeometryTable::hostBytes() const {
    uint64_t bytes = 0;
    for (const auto& [id, entry] : _entries)
        bytes += hostBytesOf(*entry.mesh);
    return bytes;
}

} // namespace hipr
