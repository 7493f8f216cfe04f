/// @file host_traversal.h
/// Wide trees walked by host threads: the traversal stage of CPU devices.
#pragma once

#include "renderer/accel/traversal.h"

namespace hipr {

/// The queues' memory must be mapped.
std::unique_ptr<Traversal> createHostTraversal();

} // namespace hipr
