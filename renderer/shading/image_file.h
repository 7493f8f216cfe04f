/// @file image_file.h
/// Picture files as they are stored, read in bands of rows; image.h turns them into texels.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "renderer/api/material.h"
#include "renderer/shading/texture_levels.h"

namespace hipr {

/// What a file says of its first picture.
struct ImageHeader {
    std::vector<LevelSize> levels; ///< stored: the picture, and coarser ones where the file is mip-mapped
    int channels = 0;              ///< 1..4; more in the file are dropped
    bool eightBit = false;         ///< pixels are uint8_t, else float
    bool large = false;            ///< values may not fit a half
    WrapMode wrapS = WrapMode::Black, wrapT = WrapMode::Black; ///< Black if the file names none
};

/// An open file. All files are read through one tile cache of OpenImageIO, of CacheMegabytes: what is read
/// stays no longer in the host's memory than it takes to decode it.
class ImageFile {
public:
    static constexpr int CacheMegabytes = 256;

    /// A file of that path on disk is read from there piece by piece, anything else comes whole from
    /// `assets`. The extension of the path picks the format. Returns null with the reason in `error`, which
    /// stays empty if there is no such file.
    static std::unique_ptr<ImageFile> open(const std::string& path, const AssetReader& assets,
                                           std::string& error);
    ~ImageFile();

    const ImageHeader& header() const { return _header; }

    /// Rows from the top, channels interleaved, alpha not multiplied in. Returns false with the reason in
    /// `error`.
    bool read(size_t level, uint32_t firstRow, uint32_t rows, void* pixels, std::string& error);

private:
    struct Source;
    ImageFile();
    bool readHeader(std::string& error);
    std::unique_ptr<Source> _source;
    ImageHeader _header;
    int _left = 0, _top = 0; ///< of the pixels in the file
};

} // namespace hipr
