/// @file lights.h
/// LightDesc -> LightRecord table with its sampling distributions.
#pragma once

#include <memory>

#include "renderer/api/scene.h"
#include "renderer/shading/categories.h"
#include "renderer/shading/mesh_light.h"
#include "renderer/shading/textures.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/light.h"
#include "shaders/shared/scene.h"

namespace hipr {

/// All lights of a scene: area lights first, then thin ones, meshes and infinite ones. Up to 16 of those with
/// a place are chosen by power, more by a tree that knows where they are. Lights that emit nothing
/// (invisible, zero or non-finite intensity, colour or size, singular transform) are left out; bad values
/// give one message that names the light. Lights are laid out by name, so that a scene looks the same to the
/// last bit whatever edits led to it. Used by one thread.
class LightTable {
public:
    LightTable(Device& device, TextureStore& textures, CategoryTable& categories);
    ~LightTable();

    /// `group`: the interned name of its group, NO_INDEX: none.
    void set(LightId id, const LightDesc& desc, uint32_t group = gpu::NO_INDEX);
    void remove(LightId id);
    /// Has the files of IES profiles read again by the next commit(). Returns whether there are any. No
    /// submission may be reading the tables.
    bool forgetProfiles();

    /// Whether lights, those that are meshes as well, cast shadows; off, all light gets through all objects.
    void setShadows(bool shadows);

    /// The lights that are instances with an emissive material, in the order of the InstanceRecords, of which
    /// there are `instanceCount`.
    void setMeshes(const std::vector<MeshLight>& meshes, uint32_t instanceCount);

    /// Rebuilds and uploads the table if a light or the bounds changed. `boundsMin/Max` bound all instances:
    /// the power of infinite lights is what falls on that sphere. Call after TextureStore::commit(). Returns
    /// whether anything was uploaded. No submission may be reading the tables.
    bool commit(const glm::vec3& boundsMin, const glm::vec3& boundsMax);

    /// Lights in the table (those that emit).
    uint32_t count() const;
    /// Whether the light emits, as far as its description tells.
    bool emits(LightId id) const;

    /// Fills SceneRecord::lights, lightCumulative, the counts and the tree of lights,
    /// and the flags SCENE_HAS_SHADOWS_TO_WALK and SCENE_HAS_MESH_LIGHTS.
    void describe(gpu::SceneRecord& scene) const;

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

} // namespace hipr
