#include "plugin/hdHipr/aov.h"

#include <unordered_map>

#include "pxr/base/gf/vec2f.h"
#include "pxr/base/gf/vec3f.h"
#include "pxr/base/gf/vec4f.h"
#include "pxr/imaging/hd/tokens.h"
#include "renderer/api/denoise.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

using hipr::AovKind;

namespace {

/// "CryptoObject00" and the like.
std::optional<hipr::AovRequest> cryptomatteRequest(std::string const& name) {
    for (auto const& [stem, kind] : cryptomatteKinds) {
        const std::string prefix = std::string(stem) + "0"; // there are less than ten layers
        const bool fits = name.size() == prefix.size() + 1 && name.compare(0, prefix.size(), prefix) == 0;
        const unsigned layer = fits ? unsigned(name.back()) - '0' : hipr::CryptomatteLayers;
        if (layer < hipr::CryptomatteLayers) {
            return hipr::AovRequest{kind, {}, layer};
        }
    }
    return std::nullopt;
}

TfToken const& denoisedToken() {
    static const TfToken token("denoised");
    return token;
}

} // namespace

bool isDenoised(TfToken const& name) {
    return name == denoisedToken();
}

std::optional<hipr::AovRequest> aovRequest(TfToken const& name) {
    static const std::unordered_map<TfToken, AovKind, TfToken::HashFunctor> kinds = {
        {HdAovTokens->color, AovKind::Color},
        {denoisedToken(), AovKind::Color},
        {HdAovTokens->depth, AovKind::Depth},
        {HdAovTokens->cameraDepth, AovKind::CameraDepth},
        {HdAovTokens->normal, AovKind::Normal},
        {HdAovTokens->Neye, AovKind::Neye},
        {HdAovTokens->Peye, AovKind::Peye},
        {HdAovTokens->patchCoord, AovKind::PatchCoord},
        {TfToken("motion"), AovKind::Motion},
        {HdAovTokens->primId, AovKind::PrimId},
        {HdAovTokens->instanceId, AovKind::InstanceId},
        {HdAovTokens->elementId, AovKind::ElementId},
        {TfToken("albedo"), AovKind::Albedo},
        {TfToken("variance"), AovKind::Variance},
        {TfToken("sampleCount"), AovKind::SampleCount},
        {TfToken("hipr:priority"), AovKind::Priority},
        {TfToken("hipr:age"), AovKind::Age},
        {TfToken("hipr:discovered"), AovKind::Discovered},
    };
    const auto found = kinds.find(name);
    if (found != kinds.end()) {
        return hipr::AovRequest{found->second, {}};
    }
    if (const auto cryptomatte = cryptomatteRequest(name.GetString())) {
        return cryptomatte;
    }
    const HdParsedAovToken parsed(name);
    if (parsed.isLpe) {
        return hipr::AovRequest{AovKind::Lpe, parsed.name.GetString()};
    }
    if (parsed.isPrimvar) {
        return hipr::AovRequest{AovKind::Primvar, parsed.name.GetString()};
    }
    return std::nullopt;
}

HdAovDescriptor aovDescriptor(TfToken const& name) {
    const std::optional<hipr::AovRequest> request = aovRequest(name);
    if (!request) {
        HdAovDescriptor unknown(HdFormatFloat32Vec4, false, VtValue(GfVec4f(0.f)));
        if (name == HdAovTokens->edgeId || name == HdAovTokens->pointId) {
            unknown = HdAovDescriptor(HdFormatInt32, false, VtValue(-1)); // nothing can be picked
        }
        // So that a host can tell a misspelt name from one that is rendered.
        unknown.aovSettings[TfToken("hipr:unknown")] = VtValue(true);
        return unknown;
    }
    switch (request->kind) {
    case AovKind::CryptoObject:
    case AovKind::CryptoMaterial:
    case AovKind::CryptoAsset:
        return HdAovDescriptor(HdFormatFloat32Vec4, false, VtValue(GfVec4f(0.f)));
    case AovKind::Color: {
        HdAovDescriptor color(HdFormatFloat32Vec4, true, VtValue(GfVec4f(0.f)));
        const std::string missing = isDenoised(name) ? hipr::Denoiser::missing() : "";
        if (!missing.empty()) { // so that a host can say so before hours of rendering
            color.aovSettings[TfToken("hipr:missing")] = VtValue(missing);
        }
        return color;
    }
    case AovKind::Depth:
        return HdAovDescriptor(HdFormatFloat32, false, VtValue(1.f));
    case AovKind::CameraDepth:
        return HdAovDescriptor(HdFormatFloat32, false, VtValue(0.f));
    case AovKind::PrimId:
    case AovKind::InstanceId:
    case AovKind::ElementId:
        return HdAovDescriptor(HdFormatInt32, false, VtValue(-1));
    case AovKind::SampleCount:
    case AovKind::Discovered:
        return HdAovDescriptor(HdFormatInt32, false, VtValue(0));
    case AovKind::Age:
        return HdAovDescriptor(HdFormatInt32, false, VtValue(-1));
    case AovKind::Priority:
        return HdAovDescriptor(HdFormatFloat32, false, VtValue(0.f));
    case AovKind::Motion:
        return HdAovDescriptor(HdFormatFloat32Vec2, false, VtValue(GfVec2f(0.f)));
    case AovKind::Albedo:
    case AovKind::Lpe:
    case AovKind::Variance:
        return HdAovDescriptor(HdFormatFloat32Vec3, true, VtValue(GfVec3f(0.f)));
    case AovKind::Normal:
    case AovKind::Neye:
    case AovKind::Primvar:
    case AovKind::Peye:
    case AovKind::PatchCoord:
        break;
    }
    return HdAovDescriptor(HdFormatFloat32Vec3, false, VtValue(GfVec3f(0.f)));
}

bool changesWithSamples(AovKind kind) {
    return kind == AovKind::Color || kind == AovKind::Albedo || kind == AovKind::Variance ||
           kind == AovKind::SampleCount || kind == AovKind::Priority || kind == AovKind::Age ||
           kind == AovKind::Discovered || kind == AovKind::CryptoObject || kind == AovKind::CryptoMaterial ||
           kind == AovKind::CryptoAsset || kind == AovKind::Lpe;
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
