#include "renderer/api/film.h"

namespace hipr {

AovFormat aovFormat(AovKind kind) {
    switch (kind) {
    case AovKind::Color:
    case AovKind::CryptoObject:
    case AovKind::CryptoMaterial:
    case AovKind::CryptoAsset:
        return {4, false};
    case AovKind::Albedo:
    case AovKind::Normal:
    case AovKind::Neye:
    case AovKind::Primvar:
    case AovKind::Peye:
    case AovKind::PatchCoord:
    case AovKind::Variance:
    case AovKind::Lpe:
        return {3, false};
    case AovKind::Motion:
        return {2, false};
    case AovKind::Depth:
    case AovKind::CameraDepth:
    case AovKind::Priority:
        return {1, false};
    case AovKind::PrimId:
    case AovKind::InstanceId:
    case AovKind::ElementId:
    case AovKind::SampleCount:
    case AovKind::Age:
    case AovKind::Discovered:
        return {1, true};
    }
    return {1, false};
}

} // namespace hipr
