/// @file mesh_lights.h
/// Finds the instances that show an emissive material and spreads light samples over their triangles.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "renderer/scene/geometry_table.h"
#include "renderer/scene/object_table.h"
#include "renderer/scene/world_box.h"
#include "renderer/shading/materials.h"
#include "renderer/shading/mesh_light.h"

namespace hipr {

/// How light samples spread over the triangles of a mesh: by area in object space times what each emits, so
/// that all instances share it.
struct TriangleSpread {
    std::vector<float> sums;    ///< of the chances of the triangles: one more than these, from 0 to 1
    double weight = 0.0;        ///< sum of areas times luminances; 0: nothing emits
    glm::dmat3 directions{0.0}; ///< sum of the same times n n^T, with the triangles' normals n
    WorldBox box;               ///< of the triangles that emit, in object space

    /// About the area times luminance of an instance: exact for flat meshes, else a mean of squares.
    double worldWeight(const glm::mat4x3& objectToWorld) const;
};

/// `luminances`: what the material of each slot emits, in nits; triangles of slots beyond it emit nothing.
TriangleSpread spreadOverTriangles(const TriangleMesh& mesh, const std::vector<float>& luminances);

/// Used by one thread. The same scene has the same lights whatever edits led to it.
class MeshLights {
public:
    explicit MeshLights(Device& device) : _device(device) {}

    /// Brings them up to date with committed objects. `materials` null: nothing emits.
    void commit(const ObjectTable& objects, const GeometryTable& geometries, const MaterialTable* materials);
    /// In the order of instances.
    const std::vector<MeshLight>& lights() const { return _lights; }

private:
    /// Of one object: the spread and the light, and what they were made from.
    struct Entry {
        std::shared_ptr<const TriangleMesh> mesh;
        std::vector<float> luminances;
        TriangleSpread spread;
        Buffer sums;
        std::shared_ptr<const SurfaceLight> asked, light;
        bool moves = false, used = false;
    };
    void spread(Entry& entry, const ObjectTable::Emitter& emitter, const Geometry& geometry,
                const MaterialTable& materials);
    void readLight(Entry& entry, const ObjectDesc& object, bool moves);
    static MeshLight lightOf(const Entry& entry, const ObjectDesc& object, uint32_t instance,
                             const glm::mat4x3& objectToWorld);

    Device& _device;
    std::map<ObjectId, Entry> _entries;
    std::vector<MeshLight> _lights;
};

} // namespace hipr
