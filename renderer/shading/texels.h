/// @file texels.h
/// The formats in which texels are stored: gpu::TEXEL_*.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

namespace hipr {

size_t bytesPerTexel(uint32_t format);

/// What texels stand for: linear, in the rendering space.
void decodeTexels(uint32_t format, const unsigned char* texels, size_t count, glm::vec4* values);

/// The nearest texels. Values must be finite, and small enough for a half where the format holds halves.
void encodeTexels(uint32_t format, const glm::vec4* values, size_t count, unsigned char* texels);

/// IEC 61966-2-1.
float decodeSrgb(float c);

} // namespace hipr
