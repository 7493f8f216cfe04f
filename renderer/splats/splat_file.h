/// @file splat_file.h
/// Captures of splats in files: 3DGS .ply (read and written), packed .ply and .spz (read).
///
/// There is no dialect of axes: positions are as the file has them. Captures in .ply usually come from
/// photogrammetry with Y down, those in .spz have Y up.
#pragma once

#include <functional>
#include <iosfwd>
#include <stdexcept>

#include "renderer/api/splats.h"

namespace hipr {

/// A file that cannot be read; what() is a sentence without the file's name.
class SplatFileError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The content of a file. Nothing is copied from it but what becomes splats.
struct ByteView {
    const unsigned char* data = nullptr;
    size_t size = 0;
};

struct SplatReadOptions {
    std::string name;     ///< of the cloud, and the subject of messages
    MessageSink messages; ///< what was left out; may be empty
    std::function<void(double)>
        progress; ///< told the fraction that has been read, now and then; may be empty
};

/// Reads 3DGS .ply as the reference implementation writes it (Kerbl et al. 2023: x y z, rot_0..3, scale_0..2,
/// opacity, f_dc_0..2 and 0, 9, 24 or 45 of f_rest_*), binary of either byte order or text, with properties
/// in any order and of any number type; what else it holds is skipped. Logarithms of scales and logits of
/// opacities are undone. Reads PlayCanvas' and SuperSplat's packed .ply too, in binary of either byte order.
/// Splats that are no numbers are left out with one message. Whatever `file` holds, memory stays below a
/// small multiple of its size.
/// @throws SplatFileError
SplatCloud readPly(ByteView file, const SplatReadOptions& options);

/// Reads .spz, versions 1 to 3 (https://github.com/nianticlabs/spz): gzip around fixed-point numbers.
/// @throws SplatFileError
SplatCloud readSpz(ByteView file, const SplatReadOptions& options);

/// Reads either, told apart by how it begins.
/// @throws SplatFileError
SplatCloud readSplats(ByteView file, const SplatReadOptions& options);

/// The same, from a path.
/// @throws SplatFileError, also when the file cannot be opened
SplatCloud readSplatFile(const std::string& path, const SplatReadOptions& options);

/// Writes what readPly reads: binary, little-endian, all floats, with normals of 0 since some viewers want
/// them. Opacities of 0 and 1 and scales of 0, which have no finite logit or logarithm, come back as such.
void writePly(const SplatCloud& cloud, std::ostream& out);

} // namespace hipr
