/// @file volume_table.h
/// Volumes, their fields and their looks by id, and the records that kernels read of them.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <vector>

#include "renderer/api/scene.h"
#include "renderer/scene/scene_dump.h"
#include "renderer/scene/world_box.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/volume.h"

namespace hipr {

/// One placement of a volume.
struct VolumePlacement {
    VolumeId volume = VolumeId::None;
    MaterialId material = MaterialId::None;
    glm::mat4x3 objectToWorld{1.f};
    std::vector<glm::mat4x3> keys; ///< object to world while the shutter is open; empty: it stands still
    WorldBox box;                  ///< in world space, at all times
    uint32_t object = 0, instance = 0, categories = 0;
    int primId = -1, instanceId = 0;
    bool operator==(const VolumePlacement& o) const {
        return volume == o.volume && material == o.material && objectToWorld == o.objectToWorld &&
               keys == o.keys && object == o.object && instance == o.instance && categories == o.categories &&
               primId == o.primId && instanceId == o.instanceId;
    }
};

/// A volume as it is in the scene.
struct VolumeEntry {
    VolumeDesc desc;
    uint32_t revision = 0; ///< goes up with every change of it or of its fields
    WorldBox box;          ///< of all its fields, in object space; empty: there is nothing of it
    uint32_t checked = 0;  ///< the revision whose fields were looked at for messages
};

/// Used by one thread, while no submission reads the scene.
class VolumeTable {
public:
    explicit VolumeTable(Device& device) : _device(device) {}

    /// Each returns what changed; None: it is the same, or an equal one.
    Change setField(FieldId id, std::shared_ptr<const FieldGrid> grid);
    Change setVolume(VolumeId id, const VolumeDesc& desc);
    Change setLook(MaterialId id, const VolumeLook& look);
    /// Each returns whether there was one.
    bool removeField(FieldId id);
    bool removeVolume(VolumeId id);
    bool removeLook(MaterialId id);

    /// Null: there is no such volume.
    const VolumeEntry* find(VolumeId id) const;
    /// The volumes that a field is part of.
    std::vector<VolumeId> showing(FieldId id) const;

    /// Uploads what changed. `placements`: all volumes that are shown.
    void commit(std::vector<VolumePlacement> placements);
    /// Fills volumes, blackbody, volumeCount and SCENE_HAS_VOLUMES; after commit().
    void describe(gpu::SceneRecord& scene) const;

    void dump(SceneDump& dump, const MaterialNames& nameOf) const;
    uint64_t hostBytes() const;

private:
    /// A grid on the device, for all fields that share it.
    struct DeviceGrid {
        Buffer buffer;
        uint64_t entries = 0, values = 0;
    };
    struct Field {
        std::shared_ptr<const FieldGrid> grid;
        std::shared_ptr<DeviceGrid> device; ///< null: to be uploaded, empty, or refused
        bool refused = false;               ///< it does not fit into memory
    };

    void fieldChanged(FieldId id);
    void reportTriples(VolumeEntry& entry);
    void updateBox(VolumeEntry& entry) const;
    const Field* shownField(FieldId id) const;
    void upload(FieldId id, Field& field);
    std::shared_ptr<DeviceGrid> toDevice(const FieldGrid& grid);
    void uploadBlackbody();
    void uploadKeys();
    gpu::FieldRecord fieldRecord(FieldId id, const glm::mat4x3& toPlaced) const;
    gpu::VolumeRecord record(const VolumePlacement& placement) const;
    void setGlow(gpu::VolumeRecord& record, const VolumeDesc& desc, const VolumeLook& look,
                 const glm::mat4x3& toPlaced) const;

    Device& _device;
    std::map<FieldId, Field> _fields;
    std::map<VolumeId, VolumeEntry> _volumes;
    std::map<MaterialId, VolumeLook> _looks;
    std::map<const FieldGrid*, std::weak_ptr<DeviceGrid>> _uploaded;
    std::vector<VolumePlacement> _placements;
    std::vector<gpu::VolumeRecord> _records;
    Buffer _table, _keyTable, _blackbody;
    uint32_t _revisions = 0;
    bool _changed = false;
};

} // namespace hipr
