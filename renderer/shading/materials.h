/// @file materials.h
/// MaterialDesc -> MaterialRecord and InputNode tables.
#pragma once

#include <map>
#include <memory>

#include "renderer/api/scene.h"
#include "renderer/shading/names.h"
#include "renderer/shading/textures.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/material.h"
#include "shaders/shared/scene.h"

namespace hipr {

/// All materials of a scene. Record 0 is the fallback look: diffuse displayColor (0.18 grey without it) and
/// presence by displayOpacity. An edit rewrites only its own record; the table grows by doubling. Used by one
/// thread.
class MaterialTable {
public:
    /// The record index of the fallback look.
    static constexpr uint32_t Fallback = 0;

    MaterialTable(Device& device, NameTable& names, TextureStore& textures);
    ~MaterialTable();

    /// Adds or replaces. Values out of their range are clamped with one message that names the material.
    void set(MaterialId id, const MaterialDesc& desc);
    void remove(MaterialId id);

    /// Record index for the material index table; Fallback for None and unknown ids. Stable while the id
    /// lives.
    uint32_t index(MaterialId id) const;

    /// Whether rays may pass straight through surfaces with this material (INSTANCE_NON_OPAQUE). For the
    /// fallback look (None and unknown ids) false: there it is up to the object's displayOpacity primvar
    /// (below 1 somewhere: non-opaque).
    bool nonOpaque(MaterialId id) const;
    /// Its name as a Cryptomatte id; for None and unknown ids that of CryptomatteNoMaterial.
    float cryptomatte(MaterialId id) const;
    /// Which material each record in use holds, but for the fallback look.
    std::map<uint32_t, MaterialId> indices() const;

    /// What of SCENE_SHADING_FEATURES these materials need.
    uint32_t features() const;

    /// Whether the material emits light.
    bool emissive(MaterialId id) const;
    /// Whether any does.
    bool anyEmissive() const;
    /// About the luminance of what it emits, in nits; 0 only if it emits nothing.
    float emittedLuminance(MaterialId id) const;

    /// Uploads changed records. Call after TextureStore::commit(). Returns whether anything was uploaded. No
    /// submission may be reading the tables.
    bool commit();

    /// Fills SceneRecord::materials.
    void describe(gpu::SceneRecord& scene) const;

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

} // namespace hipr
