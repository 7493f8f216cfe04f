/// @file cryptomatte.h
/// Cryptomatte AOVs from what kernels have counted.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>

#include "renderer/api/film.h"
#include "shaders/shared/trace.h"

namespace hipr {

static_assert(gpu::CRYPTOMATTE_RANKS == 2 * CryptomatteLayers);

inline bool isCryptomatte(AovKind kind) {
    return kind == AovKind::CryptoObject || kind == AovKind::CryptoMaterial || kind == AovKind::CryptoAsset;
}

/// Of TraceRecord::cryptomattes.
inline uint32_t cryptomatteIndex(AovKind kind) {
    return uint32_t(kind) - uint32_t(AovKind::CryptoObject);
}

using CryptoRanks = std::array<gpu::CryptoEntry, gpu::CRYPTOMATTE_RANKS>;

/// The entries of a pixel, the one that most samples saw first; of equal ones, by the bits of the id.
inline CryptoRanks cryptoRanks(const gpu::CryptoEntry* entries) {
    CryptoRanks ranks;
    std::copy_n(entries, ranks.size(), ranks.begin());
    std::sort(ranks.begin(), ranks.end(), [](const gpu::CryptoEntry& a, const gpu::CryptoEntry& b) {
        return a.count != b.count ? a.count > b.count : std::memcmp(&a.id, &b.id, sizeof(a.id)) < 0;
    });
    return ranks;
}

} // namespace hipr
