/// @file meshLight.h
/// Meshes that UsdLux's MeshLightAPI makes lights: their materials shine, and the renderer samples them as it
/// does all surfaces that emit. Only hosts that feed Hydra from scene indices tell of them (OpenUSD 22.11 and
/// later).
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "plugin/hdHipr/compat.h"
#include "renderer/api/scene.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// What the light of a mesh says.
struct MeshLight {
    /// materialSyncMode of UsdLux.
    enum class Sync { GlowTintsLight, Independent, NoResponse };
    Sync sync = Sync::GlowTintsLight;
    glm::vec3 radiance{1.f}; ///< nits; with `normalize`, times the area of the mesh
    bool normalize = false;
    std::string group; ///< for light path expressions
    std::shared_ptr<const hipr::SurfaceLight> controls;
};

/// The light of a mesh, if it is one.
std::optional<MeshLight> meshLight(HdSceneDelegate* delegate, SdfPath const& id);

/// A material as the light has it shine: GlowTintsLight scales what it emits; Independent and a mesh without
/// a material emit the light's radiance whatever they emitted before; NoResponse has nothing but that. What
/// the camera sees and what lights the scene is the same.
hipr::MaterialDesc shiningMaterial(std::optional<hipr::MaterialDesc> const& base, MeshLight const& light);

/// Area of a mesh that stands in the world by `transform`.
double worldArea(hipr::TriangleMesh const& mesh, GfMatrix4d const& transform);

/// The materials of mesh lights, which follow those they are made of. Thread-safe.
class ShiningMaterials {
public:
    /// `id` becomes the material at `base`, which is `desc` now, as `light` has it shine.
    void set(hipr::MaterialId id, SdfPath const& base, std::optional<hipr::MaterialDesc> const& desc,
             MeshLight const& light, hipr::SceneEdit& edit);
    void remove(hipr::MaterialId id, hipr::SceneEdit& edit);
    /// The material at `base` has been edited or is gone.
    void baseChanged(SdfPath const& base, std::optional<hipr::MaterialDesc> const& desc,
                     hipr::SceneEdit& edit);

private:
    struct Entry {
        SdfPath base;
        MeshLight light;
    };
    std::mutex _mutex;
    std::map<hipr::MaterialId, Entry> _entries;
};

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
