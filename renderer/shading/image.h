/// @file image.h
/// Decoding of texture files into the texel formats that kernels read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/api/material.h"
#include "renderer/color/color.h"

namespace hipr {

/// A decoded picture: 4 channels, row 0 at the bottom (t = 0). One-channel files read as (r, r, r, 1),
/// two-channel ones as (r, r, r, a), three-channel ones as (r, g, b, 1); colours are not multiplied by alpha.
struct Image {
    uint32_t width = 0, height = 0;
    uint32_t format = 0; ///< gpu::TEXEL_*
    WrapMode wrapS = WrapMode::Black,
             wrapT = WrapMode::Black; ///< from the file's metadata; Black if it has none
    bool opaque = false;              ///< alpha is 1 everywhere
    std::vector<unsigned char> texels;

    size_t bytesPerTexel() const;
    /// The decoded value of a texel: linear, in the rendering space.
    glm::vec4 texel(uint32_t x, uint32_t y) const;
};

/// Decodes a file given its bytes. `path` picks the format by its extension and names the colour-space rule's
/// file. 8-bit files stay 8-bit unless their colour space needs more than the sRGB curve; others become half
/// or, when a value does not fit, float. NaN becomes 0. Returns false with the reason in `error`; never
/// throws on bad data.
bool decodeImage(const std::vector<unsigned char>& bytes, const std::string& path,
                 const std::string& colorSpace, const ColorManager& color, Image& image, std::string& error);

} // namespace hipr
