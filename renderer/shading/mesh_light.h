/// @file mesh_light.h
/// An instance that shows an emissive material, as the table of lights knows it.
#pragma once

#include "renderer/shading/light_tree.h"

namespace hipr {

struct MeshLight {
    uint32_t instance = 0;      ///< its InstanceRecord
    uint32_t triangleCount = 0; ///< of its geometry
    uint64_t distribution = 0;  ///< LightRecord::distribution
    LightBounds bounds;
    bool operator==(const MeshLight& o) const {
        return instance == o.instance && triangleCount == o.triangleCount && distribution == o.distribution &&
               bounds.lo == o.bounds.lo && bounds.hi == o.bounds.hi && bounds.power == o.bounds.power;
    }
};

} // namespace hipr
