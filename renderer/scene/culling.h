/// @file culling.h
/// Cull styles as flags of instances.
#pragma once

#include "renderer/api/cull.h"

namespace hipr {

/// INSTANCE_CULL_* of a style.
uint32_t cullFlags(CullStyle style, bool doubleSided);

} // namespace hipr
