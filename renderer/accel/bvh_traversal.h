/// @file bvh_traversal.h
/// Binary trees walked by a compute kernel: for GPUs without ray query, and for any device on request.
#pragma once

#include "renderer/accel/traversal.h"

namespace hipr {

std::unique_ptr<Traversal> createBvhTraversal(Device& device);

} // namespace hipr
