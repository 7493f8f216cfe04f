/// @file ray_query_traversal.h
/// VK_KHR_ray_query: for devices with ray hardware.
#pragma once

#include "renderer/accel/traversal.h"

namespace hipr {

/// Throws std::runtime_error when the device has no ray query.
std::unique_ptr<Traversal> createRayQueryTraversal(Device& device);

} // namespace hipr
