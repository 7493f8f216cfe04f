/// @file mesh_light.h
/// An instance that shows an emissive material, as the table of lights knows it.
#pragma once

#include <memory>
#include <string>

#include "renderer/shading/light_tree.h"

namespace hipr {

/// Whether two are equal; none is equal to none.
inline bool sameLight(const std::shared_ptr<const SurfaceLight>& a,
                      const std::shared_ptr<const SurfaceLight>& b) {
    return a == b || (a && b && *a == *b);
}

struct MeshLight {
    uint32_t instance = 0;      ///< its InstanceRecord
    uint32_t triangleCount = 0; ///< of its geometry
    uint64_t distribution = 0;  ///< LightRecord::distribution
    LightBounds bounds;
    std::shared_ptr<const SurfaceLight> light; ///< ObjectDesc::light, of finite numbers
    std::string name;                          ///< with `light`: of the object
    glm::mat4x3 objectToWorld{1.f};            ///< with `light`
    bool operator==(const MeshLight& o) const {
        return instance == o.instance && triangleCount == o.triangleCount && distribution == o.distribution &&
               bounds.lo == o.bounds.lo && bounds.hi == o.bounds.hi && bounds.power == o.bounds.power &&
               sameLight(light, o.light) && name == o.name && objectToWorld == o.objectToWorld;
    }
};

} // namespace hipr
