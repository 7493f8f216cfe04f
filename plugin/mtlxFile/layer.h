/// @file layer.h
/// A MaterialX document as a layer of USD.
#pragma once

#include "plugin/mtlxFile/document.h"
#include "pxr/pxr.h"
#include "pxr/usd/sdf/layer.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The layer, laid out as OpenUSD's own usdMtlx does, so that files which reference its prims work with
/// either:
///
///     /MaterialX/Materials/<material>/<shader>    with the node graphs it uses, by references
///     /MaterialX/NodeGraphs/<graph>/<node>        graphs, nodes outside of graphs, and under the name of
///     their
///                                                 definition the graphs of custom nodes
///     /MaterialX/Collections, /MaterialX/Looks    if the document has looks, and then
///     /ModelRoot                                  which has them as variants of the set LookVariant
///
/// Shaders have the names of MaterialX's node definitions as `info:id`; nodes that the document defines by
/// a graph are references to it. A colour space is metadata of the attribute, and since an old UsdImaging
/// does not pass that on, also the input `colorSpace:<name>` of the shader.
SdfLayerRefPtr mtlxLayer(hipr::mtlx::Document const& document);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
