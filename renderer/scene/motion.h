/// @file motion.h
/// Motion as authored -> keys at equal distances over the shutter, as kernels and traversals take them
/// (shaders/shared/motion.h).
#pragma once

#include <cstdint>

#include <glm/gtc/quaternion.hpp>

#include "renderer/api/mesh.h"
#include "renderer/api/motion.h"

namespace hipr {

/// The most keys anything has.
constexpr uint32_t MaxMotionKeys = 65;

/// The distances into which keys divide the shutter so that every authored time between has one: at most 16,
/// where times that fit no such grid lie up to 1/32 of the shutter off.
uint32_t keySteps(const std::vector<float>& times, const Shutter& shutter);

/// The time of key `key` of `keys`, in frames.
double keyFrame(const Shutter& shutter, uint32_t key, uint32_t keys);

/// One placement over time, taken apart into rotation, stretch and translation.
class PlacementMotion {
public:
    /// As many placements as times, two or more. None may be singular.
    PlacementMotion(const std::vector<float>& times, const std::vector<glm::dmat4x3>& placements);

    bool moves() const;
    /// Keys for straight ways between them to stay within 0.06 % of the distance to the axis from the way
    /// that a rotation takes: one every 4 degrees, as far as MaxMotionKeys goes.
    uint32_t keys(const Shutter& shutter) const;
    glm::dmat4x3 at(double time) const;

private:
    struct Sample {
        double time;
        glm::dmat4x3 placement;
        glm::dquat rotation;
        glm::dmat3 stretch;
    };
    std::vector<Sample> _samples;
};

/// Keys of a mesh that deforms: 1 where it does not.
uint32_t meshKeys(const TriangleMesh& mesh, const Shutter& shutter);
/// Positions (or normals) for that many keys, one behind the other.
std::vector<glm::vec3> keyed(const TriangleMesh& mesh, std::vector<glm::vec3> MeshKey::*values,
                             const Shutter& shutter, uint32_t keys);

} // namespace hipr
