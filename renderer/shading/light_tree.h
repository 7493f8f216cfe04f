/// @file light_tree.h
/// The tree by which one of many lights is chosen, and by which rays find the lights on their way. See
/// shaders/light/tree.glsl.
#pragma once

#include <vector>

#include "renderer/api/light.h"
#include "shaders/shared/light.h"

namespace hipr {

/// Where a light is and where it sends its light: a box in world space; directions within `spread` of `axis`
/// are normals of its surface, and light leaves within `emission` of one.
struct LightBounds {
    glm::vec3 lo{0.f}, hi{0.f};
    glm::vec3 axis{0.f, 0.f, 1.f};
    double spread = 0.0, emission = 0.0; ///< radians, up to pi
    double power = 0.0;
    uint32_t links = 0xffffffffu; ///< LightNode::links
};

/// Bounds of the light of a record, which is not a dome or a distant one. `coneAngle`: of its shaping, in
/// radians; pi and above: none.
LightBounds boundsOf(const gpu::LightRecord& record, double coneAngle, double power);

/// Narrows bounds by a cone around the unit vector `axis`, within which light leaves whatever the normal
/// there.
void narrow(LightBounds& bounds, const glm::vec3& axis, double coneAngle);

/// A tree over all lights, the i-th being that of record i. The same for the same bounds, whatever was
/// before. `leaves`: the node of each light.
std::vector<gpu::LightNode> buildLightTree(const std::vector<LightBounds>& lights,
                                           std::vector<uint32_t>& leaves);

} // namespace hipr
