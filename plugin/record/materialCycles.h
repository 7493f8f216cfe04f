/// @file materialCycles.h
/// Protects OpenUSD from materials whose nodes feed each other.
#pragma once

#include "pxr/pxr.h"
#include "pxr/usd/usd/stage.h"

namespace hipr::record {

/// Takes one connection out of every cycle of shading nodes, in the session layer, and says which. UsdImaging
/// of 20.08 follows such a cycle until its stack overflows, before any renderer sees the material. Materials
/// inside the prototypes of native instances cannot be edited and are left alone.
void cutMaterialCycles(const PXR_NS::UsdStageRefPtr& stage);

} // namespace hipr::record
