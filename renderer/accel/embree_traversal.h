/// @file embree_traversal.h
/// Embree 3 on the host as the traversal stage of CPU devices.
#pragma once

#include "renderer/accel/traversal.h"

namespace hipr {

/// Throws std::runtime_error when Embree cannot start. The queues' memory must be mapped.
std::unique_ptr<Traversal> createEmbreeTraversal();

} // namespace hipr
