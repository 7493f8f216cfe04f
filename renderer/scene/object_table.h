/// @file object_table.h
/// Objects and their instances -> InstanceRecord and material index tables.
#pragma once

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "renderer/scene/culling.h"
#include "renderer/scene/geometry_table.h"
#include "renderer/scene/splat_table.h"
#include "renderer/scene/volume_table.h"
#include "renderer/scene/world_box.h"
#include "renderer/shading/categories.h"
#include "renderer/shading/materials.h"
#include "shaders/shared/hipr.h"

namespace hipr {

/// Instances are laid out by the names of their objects, so that a scene looks the same to the last bit
/// whatever edits led to it.
class ObjectTable {
public:
    ObjectTable(Device& device, NameTable& names, CategoryTable& categories)
        : _device(device), _names(names), _categories(categories) {}

    /// Each reports what differs from before into `changed`. Between two commits, instances are to be set
    /// once per object: removed ones are named by their index in the committed scene.
    void setObject(ObjectId id, const ObjectDesc& desc, ChangedSet& changed);
    void setInstances(ObjectId id, const InstancesDesc& desc, ChangedSet& changed);
    void removeObject(ObjectId id, ChangedSet& changed);
    /// Reports a change of a geometry for all objects that show it.
    void geometryChanged(GeometryId id, Change change, ChangedSet& changed);
    void splatsChanged(SplatsId id, ChangedSet& changed);
    void volumeChanged(VolumeId id, Change change, ChangedSet& changed);
    /// Reports all objects whose light has an IES profile.
    void profilesChanged(ChangedSet& changed);
    /// Calls `visit` with the description of every object, by id.
    template <class Visitor> void forObjects(Visitor&& visit) const {
        for (const auto& [id, entry] : _entries)
            if (entry.desc) visit(*entry.desc);
    }
    /// Whether any change reported since the last commit() is of an object that paths meet.
    bool tracedChanged() const { return _tracedChanged; }

    /// Brings the tables up to date with objects, geometries and materials. Returns whether an instance
    /// changed in a way a traversal must know. `materials` null: every object shows the fallback look.
    bool commit(const GeometryTable& geometries, const SplatTable& splats, const VolumeTable& volumes,
                const MaterialTable* materials);
    /// Takes effect in commit().
    void setShutter(const Shutter& shutter);
    /// Whether kernels are told what slots are called. Takes effect in commit(); returns whether that is new.
    bool keepNames(bool keep) { return std::exchange(_keepsNames, keep) != keep; }
    /// What objects that inherit their style have. Takes effect in commit().
    void setViewCull(CullStyle style) { _viewCull = style; }
    /// Whether some object is a light, that is, has ObjectDesc::light.
    bool anyLights() const;
    /// Whether any instance has motion.
    bool anyMotion() const;

    const std::vector<gpu::InstanceRecord>& records() const { return _records; }
    /// An object that shows a material which emits: its records are `count` from `first` on.
    struct Emitter {
        ObjectId id;
        const ObjectDesc* desc;
        uint32_t first, count;
    };
    /// In the order of their records; as of the last commit.
    std::vector<Emitter> emitters(const MaterialTable& materials) const;
    /// The records, and where those that move are while the shutter is open.
    InstanceView instances() const { return {_records, _keys, _keyTable.address()}; }
    /// Where clouds of splats stand, in the order of the objects' names; as of the last commit.
    std::vector<SplatPlacement> splats() const;
    /// Where volumes stand, likewise.
    std::vector<VolumePlacement> volumes() const;
    /// Goes up with every commit() after which splats() or the clouds it names are others.
    uint64_t splatRevision() const { return _splatRevision; }
    /// Where objects that were changed since the last call had been before; for after the edits, before
    /// commit().
    std::vector<WorldBox> takeVacated() { return std::exchange(_vacated, {}); }
    /// Where the element of a changed set is, once committed: an object's instance, or all that show a
    /// material.
    void addOccupied(const ChangedElement& element, std::vector<WorldBox>& regions) const;
    /// Adds the instances that the element of a changed set is, or in which it shows.
    void addKeys(const ChangedElement& element, std::vector<gpu::ElementKey>& keys) const;
    /// Fills instances, materialIndices, instanceCount, bounds and SCENE_HAS_NON_OPAQUE.
    void describe(gpu::SceneRecord& scene) const;
    /// Every object with what it shows, as of the last commit.
    void dump(SceneDump& dump, const GeometryTable& geometries, const SplatTable& splats,
              const VolumeTable& volumes, const MaterialNames& nameOf) const;

private:
    CullStyle styleOf(const ObjectDesc& desc) const {
        return desc.cull == CullStyle::Inherit ? _viewCull : desc.cull;
    }
    /// Where an object's instances are and what they have in common.
    struct Placement {
        uint32_t first = 0, count = 0, geometry = 0, firstMaterial = 0, materialCount = 0, flags = 0;
        int primId = -1;
        uint32_t categories = 0;
        uint32_t firstKey = 0, keyCount = 0; ///< of the first instance; of each one
        bool operator==(const Placement& o) const;
    };
    struct Entry {
        std::optional<ObjectDesc> desc;
        std::optional<InstancesDesc> instances; ///< none: stands once, untransformed
        std::vector<uint32_t> usable;           ///< indices of transforms that can be rendered
        std::vector<glm::mat4x3> keys;          ///< of `usable`, keyCount each
        uint32_t keyCount = 0;                  ///< 0: they stand still
        Placement placed;
        Buffer primvars;
        uint32_t primvarCount = 0;
        uint64_t primvarTable = 0;
        WorldBox meshBox, box; ///< of the geometry, splats or volume, in object space; of all instances
        bool transformsPending = true, boundsPending = true;
        bool missingReported = false;
        bool fresh = false;     ///< added since the last commit: what else is said of it is no change
        gpu::SlotNames names{}; ///< but for the material
        std::vector<SplatPlacement> splats;   ///< of `usable`, as of the last commit
        uint32_t splatSet = 0;                ///< SplatSet::revision of what they show
        std::vector<VolumePlacement> volumes; ///< of `usable`, as of the last commit
        uint32_t volumeRevision = 0;          ///< VolumeEntry::revision of what they show
    };

    void dumpInstances(SceneDump::Element& out, const Entry& entry) const;
    void note(ChangedSet& changed, ObjectId id, const Entry& entry, Change change,
              uint32_t instance = ChangedElement::AllInstances);
    void reportMissing(Entry& entry, const char* what);
    const Geometry* shownGeometry(Entry& entry, const GeometryTable& geometries);
    const SplatSet* shownSplats(Entry& entry, const SplatTable& splats);
    void placeSplats(Entry& entry, const SplatSet* shown, bool transformsChanged);
    const VolumeEntry* shownVolume(Entry& entry, const VolumeTable& volumes);
    void placeVolumes(ObjectId id, Entry& entry, const VolumeEntry* shown, bool transformsChanged);
    static size_t placedCount(const Entry& entry) {
        return entry.placed.count + entry.splats.size() + entry.volumes.size();
    }
    const glm::mat4x3& placedTransform(const Entry& entry, uint32_t i) const;
    Placement place(Entry& entry, const Geometry* geometry, const MaterialTable* materials, uint32_t first,
                    std::vector<uint32_t>& materialIndices);
    gpu::SlotNames namesOf(const ObjectDesc& desc);
    void uploadNames(const MaterialTable* materials);
    /// Ids by the name of the object: hits at equal distance go to the first, and ids tell the history of
    /// edits.
    const std::vector<ObjectId>& order();
    void findUsable(Entry& entry);
    void findKeys(Entry& entry);
    void uploadKeys();
    void uploadPrimvars(Entry& entry);
    uint32_t categoriesOf(const Entry& entry, uint32_t instance);
    void writeRecords(ObjectId id, Entry& entry);
    void uploadRecords(const std::vector<std::pair<ObjectId, Entry*>>& rewritten);
    void summarise(const GeometryTable& geometries);
    void updateBox(Entry& entry) const;
    void vacate(const Entry& entry, uint32_t instance = ChangedElement::AllInstances);
    WorldBox placedBox(const Entry& entry, uint32_t i) const;
    WorldBox instanceBox(const Entry& entry, uint32_t instance) const;
    template <class Visitor> void forObjectsShowing(MaterialId material, Visitor&& visit) const;

    Device& _device;
    NameTable& _names;
    CategoryTable& _categories;
    std::map<ObjectId, Entry> _entries;
    std::vector<ObjectId> _order; ///< of another size than `_entries`: to be made anew
    std::vector<gpu::InstanceRecord> _records;
    std::vector<uint32_t> _materialIndices;
    std::vector<glm::mat4x3> _keys; ///< see InstanceRecord::firstKey
    Shutter _shutter;
    CullStyle _viewCull = CullStyle::Nothing;
    DeviceTable _recordTable, _materialTable, _slotNameTable, _keyTable;
    std::vector<WorldBox> _vacated;
    glm::vec3 _boundsMin{0.f}, _boundsMax{0.f};
    uint64_t _splatRevision = 0;
    bool _nonOpaque = false, _tracedChanged = false, _keepsNames = false;
};

} // namespace hipr
