/// @file geometry_table.h
/// Triangle meshes -> GeometryRecord table. Every mesh is stored once, however many instances it has.
#pragma once

#include <unordered_map>
#include <vector>

#include "renderer/accel/traversal.h"
#include "renderer/api/scene.h"
#include "renderer/scene/buffer_pack.h"
#include "renderer/scene/scene_dump.h"
#include "renderer/shading/names.h"

namespace hipr {

/// Host memory of a mesh.
uint64_t hostBytesOf(const TriangleMesh& mesh);

struct Geometry {
    uint32_t slot = 0; ///< index of its GeometryRecord and its slot in the traversal
    std::shared_ptr<const TriangleMesh> mesh;
    uint32_t slotCount = 1;   ///< material slots in use
    bool translucent = false; ///< its displayOpacity is below 1 somewhere
    uint32_t keys = 1;        ///< GeometryRecord::keys
};

class GeometryTable {
public:
    GeometryTable(Device& device, NameTable& names) : _device(device), _names(names) {}

    /// Adds or replaces. Returns what differs from the mesh before: None (also for an equal mesh at another
    /// address), Added, Geometry (positions or triangles), or Primvar (anything else).
    Change set(GeometryId id, std::shared_ptr<const TriangleMesh> mesh);
    /// Returns whether the geometry existed.
    bool remove(GeometryId id);
    const Geometry* find(GeometryId id) const;

    /// Takes effect in commit().
    void setShutter(const Shutter& shutter);
    /// Whether any mesh deforms.
    bool anyMotion() const;
    /// Whether any is made of round segments.
    bool anySegments() const;

    /// Uploads what changed and hands new shapes to the traversal, which builds them in its own commit().
    void commit(Traversal& traversal);
    /// A new traversal has none of the geometries yet.
    void resubmit();

    void dump(SceneDump& dump) const;
    void describe(gpu::SceneRecord& scene) const { scene.geometries = _records.address(); }
    /// Host memory of the meshes.
    uint64_t hostBytes() const;

private:
    struct Entry : Geometry {
        Buffer shape, attributes; ///< apart, so that new primvars leave the traversal alone
        gpu::GeometryRecord record{};
        std::shared_ptr<const TriangleMesh> submitted; ///< the mesh the traversal has
        uint32_t submittedKeys = 1;
        std::vector<glm::vec3> keyPositions; ///< for a traversal that cannot read those in `shape`
        bool shapePending = true, attributesPending = true;
    };
    void uploadShape(Entry& entry);
    void uploadAttributes(Entry& entry);
    void submit(Entry& entry, Traversal& traversal);

    Device& _device;
    NameTable& _names;
    std::unordered_map<GeometryId, Entry> _entries;
    std::vector<uint32_t> _freeSlots, _removedSlots;
    std::vector<Buffer> _retired; ///< shapes the traversal may still refer to
    uint32_t _slotCount = 0;
    bool _recordsPending = false;
    DeviceTable _records;
    Shutter _shutter;
};

} // namespace hipr
