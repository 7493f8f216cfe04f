#include "renderer/api/cryptomatte.h"

#include <cstring>

namespace hipr {
namespace {

uint32_t rotated(uint32_t x, int bits) {
    return x << bits | x >> (32 - bits);
}

uint32_t scrambled(uint32_t block) {
    return rotated(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

/// A. Appleby's MurmurHash3_x86_32, seed 0.
uint32_t murmur3(std::string_view text) {
    uint32_t hash = 0, tail = 0;
    const size_t whole = text.size() / 4 * 4;
    const auto byte = [&](size_t i) { return uint32_t(uint8_t(text[i])); };
    for (size_t i = 0; i < whole; i += 4) {
        const uint32_t block = byte(i) | byte(i + 1) << 8 | byte(i + 2) << 16 | byte(i + 3) << 24;
        hash = rotated(hash ^ scrambled(block), 13) * 5 + 0xe6546b64u;
    }
    for (size_t i = text.size(); i-- > whole;)
        tail = tail << 8 | byte(i);
    hash ^= scrambled(tail); // 0 without a tail
    hash ^= uint32_t(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

} // namespace

uint32_t cryptomatteBits(std::string_view name) {
    const uint32_t hash = murmur3(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

float cryptomatteId(std::string_view name) {
    const uint32_t bits = cryptomatteBits(name);
    float id;
    std::memcpy(&id, &bits, sizeof(id));
    return id;
}

} // namespace hipr
