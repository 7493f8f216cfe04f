/// @file assets.h
/// Textures through ArResolver, so that packages (.usdz) and custom resolvers work.
#pragma once

#include <string>

#include "pxr/base/vt/value.h"
#include "pxr/pxr.h"
#include "renderer/api/types.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Reads through ArAsset; never opens a resolved path as a file.
hipr::AssetReader assetReader();

/// The path to hand to the renderer for a value that holds an SdfAssetPath (or text): the resolved path when
/// there is one, else the path as authored, so that a message about it can name it. Keeps `<UDIM>` patterns.
std::string assetPath(VtValue const& value);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
