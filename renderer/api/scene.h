/// @file scene.h
/// Descriptions of what is in the scene, and the edits that change it.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <variant>

#include "renderer/api/camera.h"
#include "renderer/api/cull.h"
#include "renderer/api/light.h"
#include "renderer/api/material.h"
#include "renderer/api/mesh.h"
#include "renderer/api/motion.h"
#include "renderer/api/splats.h"
#include "renderer/api/volume.h"

namespace hipr {

/// An object: one geometry, one cloud of splats or one volume, its materials, and its placement.
struct ObjectDesc {
    std::string name;
    GeometryId geometry = GeometryId::None;
    std::vector<MaterialId>
        materials; ///< by slot; a missing or None entry uses the fallback look (displayColor)
    bool visible = true;
    int primId = -1;                  ///< written to the primId AOV
    SplatsId splats = SplatsId::None; ///< a cloud of splats, which has no materials, instead of a geometry
    std::vector<std::string> categories{}; ///< what lights may be linked to: LightDesc::lightLink, shadowLink
    VolumeId volume = VolumeId::None; ///< a volume instead of a geometry; its material is the first one
    std::string asset{}; ///< what Cryptomatte takes it for a part of; empty: of itself
    std::string lightGroup{}; ///< of the light that it emits, for light path expressions; empty: none
    CullStyle cull = CullStyle::Inherit;
    std::shared_ptr<const SurfaceLight> light{}; ///< of what its triangles emit; null: nothing beside that
};

/// All placements of one object. The geometry is never copied per instance. An object that was never given
/// instances stands once, untransformed; one that was given none is not seen.
struct InstancesDesc {
    std::vector<glm::mat4x3> transforms; ///< object to world, column-major 4 columns of 3 rows
    std::vector<int> instanceIds;        ///< written to the instanceId AOV; empty: 0, 1, 2...
    std::vector<Primvar> primvars; ///< one value per instance; override the mesh's primvar of the same name
    std::vector<std::vector<std::string>>
        categories{}; ///< of each instance, beside the object's; may be shorter
    InstanceMotion motion{}; ///< where they are while the shutter is open; `transforms` is at the frame's time
};

/// What kind of change happened to an element; bits combine.
enum class Change : uint32_t {
    None = 0,
    Added = 1u << 0,
    Removed = 1u << 1,
    Transform = 1u << 2,
    Geometry = 1u << 3, ///< topology or points
    Primvar = 1u << 4,
    Material = 1u << 5, ///< binding or content
    Emission = 1u << 6,
    Visibility = 1u << 7,
    Camera = 1u << 8,
    Setting = 1u << 9,  ///< a setting that matters to the picture, or the film
    Linking = 1u << 10, ///< the categories by which lights are linked
};
constexpr Change operator|(Change a, Change b) {
    return Change(uint32_t(a) | uint32_t(b));
}
constexpr bool operator&(Change a, Change b) {
    return (uint32_t(a) & uint32_t(b)) != 0;
}
/// Its kinds in words: "transform, material".
std::string toString(Change change);

/// One changed element. `instance` is the index into InstancesDesc::transforms (before the edit if the
/// instance was removed), or AllInstances.
struct ChangedElement {
    static constexpr uint32_t AllInstances = std::numeric_limits<uint32_t>::max();
    std::variant<std::monostate, ObjectId, LightId, MaterialId> element; ///< monostate: camera or setting
    Change change = Change::None;
    uint32_t instance = AllInstances;
};

/// What a commit changed; the input of HiPR's schedule. An element is named once, or once for each instance
/// concerned; a new one is Added, and whatever else was said of it meanwhile is no change.
struct ChangedSet {
    std::vector<ChangedElement> elements;
    bool empty() const { return elements.empty(); }
    /// The kinds of all elements together.
    Change kinds() const;
};

/// A batch of changes. All methods are thread-safe; later calls for the same id win.
class SceneEdit {
public:
    void setGeometry(GeometryId id, std::shared_ptr<const TriangleMesh> mesh);
    void removeGeometry(GeometryId id);
    void setSplats(SplatsId id, std::shared_ptr<const SplatCloud> cloud);
    void removeSplats(SplatsId id);
    void setField(FieldId id, std::shared_ptr<const FieldGrid> grid);
    void removeField(FieldId id);
    void setVolume(VolumeId id, VolumeDesc desc);
    void removeVolume(VolumeId id);
    /// What a material says of the volumes it is bound to; it may be a material of surfaces as well.
    void setVolumeLook(MaterialId id, VolumeLook look);
    void removeVolumeLook(MaterialId id);
    void setMaterial(MaterialId id, MaterialDesc desc);
    void removeMaterial(MaterialId id);
    void setLight(LightId id, LightDesc desc);
    void removeLight(LightId id);
    void setObject(ObjectId id, ObjectDesc desc);
    void setInstances(ObjectId id, InstancesDesc desc);
    void removeObject(ObjectId id);
    void setCamera(const CameraDesc& camera);

    bool empty() const;
    void clear();

    /// Moves the recorded calls of `later` behind those of this edit; `later` is empty afterwards.
    void append(SceneEdit& later);

    /// One recorded call; a null payload means removal.
    struct GeometryOp {
        GeometryId id;
        std::shared_ptr<const TriangleMesh> mesh;
    };
    struct SplatsOp {
        SplatsId id;
        std::shared_ptr<const SplatCloud> cloud;
    };
    struct FieldOp {
        FieldId id;
        std::shared_ptr<const FieldGrid> grid;
    };
    struct VolumeOp {
        VolumeId id;
        std::optional<VolumeDesc> desc;
    };
    struct VolumeLookOp {
        MaterialId id;
        std::optional<VolumeLook> look;
    };
    struct MaterialOp {
        MaterialId id;
        std::optional<MaterialDesc> desc;
    };
    struct LightOp {
        LightId id;
        std::optional<LightDesc> desc;
    };
    struct ObjectOp {
        ObjectId id;
        std::optional<ObjectDesc> desc;
    };
    struct InstancesOp {
        ObjectId id;
        InstancesDesc desc;
    };
    struct CameraOp {
        CameraDesc desc;
    };
    using Op = std::variant<GeometryOp, SplatsOp, MaterialOp, LightOp, ObjectOp, InstancesOp, CameraOp, FieldOp,
                            VolumeOp, VolumeLookOp>;

    /// Moves the recorded calls out, in order. Used by Renderer::commit().
    std::vector<Op> take();

private:
    void record(Op op);

    mutable std::mutex _mutex;
    std::vector<Op> _ops;
};

} // namespace hipr
