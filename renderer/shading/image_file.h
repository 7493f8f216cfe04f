/// @file image_file.h
/// Picture files as they are stored (OpenImageIO); image.h turns them into texels.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/api/material.h"

namespace hipr {

/// The first picture of a file: rows from the top, channels interleaved, alpha not multiplied in.
struct ImageFile {
    uint32_t width = 0, height = 0;
    int channels = 0;      ///< 1..4; more in the file are dropped
    bool eightBit = false; ///< pixels are uint8_t, else float
    WrapMode wrapS = WrapMode::Black, wrapT = WrapMode::Black;
    std::vector<unsigned char> pixels;
};

/// Returns false with the reason in `error`. Bytes are decoded in memory where the format's reader can, else
/// through a temporary file.
bool readImageFile(const std::vector<unsigned char>& bytes, const std::string& path, ImageFile& file,
                   std::string& error);

} // namespace hipr
