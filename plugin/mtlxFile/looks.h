/// @file looks.h
/// Looks of a MaterialX document: which materials are assigned to what.
#pragma once

#include "plugin/mtlxFile/document.h"
#include "plugin/mtlxFile/prims.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Writes /MaterialX/Collections, /MaterialX/Looks and /ModelRoot; nothing for a document without looks.
/// Geometry `/a/b` is the prim a/b below the one that references /ModelRoot, "/" and "*" are that prim
/// itself. Names with other wildcards are told and left out.
void mtlxLooks(hipr::mtlx::Document const& document, PrimWriter& prims);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
