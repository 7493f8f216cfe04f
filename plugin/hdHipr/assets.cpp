#include "plugin/hdHipr/assets.h"

#include "plugin/hdHipr/compatAssets.h"
#include "pxr/usd/sdf/assetPath.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

const std::string udim = "<UDIM>";

/// A UDIM pattern is no asset itself: its first tile is resolved and the pattern put back.
std::string resolvePattern(std::string const& path) {
    const size_t at = path.find(udim);
    if (at == std::string::npos) {
        return resolveAsset(path);
    }
    const std::string tile = "1001";
    std::string first = path;
    first.replace(at, udim.size(), tile);
    std::string resolved = resolveAsset(first);
    const size_t found = resolved.rfind(tile);
    if (found == std::string::npos) {
        return {};
    }
    return resolved.replace(found, tile.size(), udim);
}

} // namespace

hipr::AssetReader assetReader() {
    return [](const std::string& path) { return readAsset(path); };
}

std::string assetPath(VtValue const& value) {
    std::string authored;
    if (value.IsHolding<SdfAssetPath>()) {
        SdfAssetPath const& asset = value.UncheckedGet<SdfAssetPath>();
        if (!asset.GetResolvedPath().empty()) {
            return asset.GetResolvedPath();
        }
        authored = asset.GetAssetPath();
    } else if (value.IsHolding<std::string>()) {
        authored = value.UncheckedGet<std::string>();
    }
    if (authored.empty()) {
        return {};
    }
    const std::string resolved = resolvePattern(authored);
    return resolved.empty() ? authored : resolved;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
