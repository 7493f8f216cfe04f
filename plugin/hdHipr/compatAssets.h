/// @file compatAssets.h
/// How OpenUSD 20.08 .. 26.x differ in what resolvers are asked: the part of compat.h that needs no Hydra.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pxr/pxr.h"
#include "pxr/usd/ar/asset.h"
#include "pxr/usd/ar/resolver.h"

#if PXR_VERSION >= 2203
#include "pxr/usd/ar/resolvedPath.h"
#endif

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// The content of an asset, not copied where the resolver can show it as it is (files are mapped).
struct AssetBytes {
    std::shared_ptr<const unsigned char> data; ///< null: it cannot be opened
    size_t size = 0;
};

/// Opens an asset by its resolved path; an empty one is that of nothing.
inline AssetBytes openAsset(std::string const& resolvedPath) {
    if (resolvedPath.empty()) {
        return {};
    }
    ArResolver& resolver = ArGetResolver();
    using Resolved = decltype(resolver.Resolve(resolvedPath)); // text, or a type of its own from 21.11 on
    const std::shared_ptr<ArAsset> asset = resolver.OpenAsset(Resolved(resolvedPath));
    if (asset && asset->GetSize() == 0) { // has no buffer
        static const unsigned char nothing = 0;
        return {{asset, &nothing}, 0};
    }
    const std::shared_ptr<const char> bytes = asset ? asset->GetBuffer() : nullptr;
    if (!bytes) {
        return {};
    }
    return {{bytes, reinterpret_cast<const unsigned char*>(bytes.get())}, asset->GetSize()};
}

/// The whole content of an asset by any path a resolver understands (files, packages, custom schemes), or
/// nothing.
inline std::vector<unsigned char> readAsset(std::string const& path) {
    const AssetBytes asset = openAsset(std::string(ArGetResolver().Resolve(path)));
    return std::vector<unsigned char>(asset.data.get(), asset.data.get() + asset.size);
}

/// The path of an asset that is named in the asset with the resolved path `anchor`.
inline std::string anchorAsset(std::string const& anchor, std::string const& asset) {
#if PXR_VERSION < 2111
    return ArGetResolver().AnchorRelativePath(anchor, asset);
#else
    return ArGetResolver().CreateIdentifier(asset, ArResolvedPath(anchor));
#endif
}

/// The resolved form of an asset path, or an empty string.
inline std::string resolveAsset(std::string const& path) {
    return std::string(ArGetResolver().Resolve(path));
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
