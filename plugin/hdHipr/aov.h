/// @file aov.h
/// Hydra's AOV names <-> the renderer's AOVs.
#pragma once

#include <optional>
#include <utility>

#include "pxr/base/vt/value.h"
#include "pxr/imaging/hd/aov.h"
#include "pxr/pxr.h"
#include "renderer/api/film.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// Cryptomatte's AOVs are these names with the number of a layer, "CryptoObject00" to "CryptoAsset02".
constexpr std::pair<const char*, hipr::AovKind> cryptomatteKinds[] = {
    {"CryptoObject", hipr::AovKind::CryptoObject},
    {"CryptoMaterial", hipr::AovKind::CryptoMaterial},
    {"CryptoAsset", hipr::AovKind::CryptoAsset}};

/// The renderer's AOV of that name, or nothing for a name HiPR does not know (shader:*, edgeId...).
std::optional<hipr::AovRequest> aovRequest(TfToken const& name);

/// Whether the AOV is color without noise: see Denoising. Its aovRequest() is that of color.
bool isDenoised(TfToken const& name);

/// The preferred format and clear value of an AOV. Unknown names get a usable descriptor as well.
HdAovDescriptor aovDescriptor(TfToken const& name);

/// First-hit AOVs are final after the first sample; means go on changing until the picture has converged.
bool changesWithSamples(hipr::AovKind kind);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
