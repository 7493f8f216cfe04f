/// @file image.h
/// Decoding of texture files into the texel formats that kernels read.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "renderer/api/material.h"
#include "renderer/color/color.h"
#include "renderer/shading/image_file.h"

namespace hipr {

/// A decoded picture: 4 channels, row 0 at the bottom (t = 0). One-channel files read as (r, r, r, 1),
/// two-channel ones as (r, r, r, a), three-channel ones as (r, g, b, 1); colours are not multiplied by alpha.
struct Image {
    uint32_t width = 0, height = 0; ///< of the finest level that is there
    uint32_t format = 0;            ///< gpu::TEXEL_*
    WrapMode wrapS = WrapMode::Black,
             wrapT = WrapMode::Black;  ///< from the file's metadata; Black if it has none
    bool opaque = false;               ///< alpha is 1 everywhere
    std::vector<unsigned char> texels; ///< levels one after the other, the finest first

    /// The decoded value of a texel of the finest level: linear, in the rendering space.
    glm::vec4 texel(uint32_t x, uint32_t y) const;
};

/// The format texels of a file get, as far as its header tells: values of 32 bits become halves if all fit.
/// 8-bit files stay 8-bit unless their colour space needs more than the sRGB curve; others become half or,
/// when a value does not fit, float.
uint32_t texelFormat(const ImageHeader& header, const std::string& colorSpace, const ColorManager& color);

/// Decodes a file. Infinity becomes the largest half, NaN 0. Returns false with the reason in `error`; never
/// throws on bad data.
bool decodeImage(ImageFile& file, const std::string& colorSpace, const ColorManager& color, Image& image,
                 std::string& error);

/// The same with all coarser levels, without those finer than `finest`. Levels that the file has are its own,
/// where they suffice nothing finer is read; others are made by LevelBuilder. Colours that are encoded count
/// by their alpha.
bool decodeLevels(ImageFile& file, const std::string& colorSpace, const ColorManager& color, size_t finest,
                  Image& image, std::string& error);

} // namespace hipr
