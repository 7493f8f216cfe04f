#include "renderer/splats/splat_file.h"

#include <cstring>

#include "renderer/splats/mapped_file.h"

namespace hipr {

SplatCloud readSplats(ByteView file, const SplatReadOptions& options) {
    if (file.size == 0) throw SplatFileError("is empty");
    if (file.size >= 3 && std::memcmp(file.data, "ply", 3) == 0) return readPly(file, options);
    if (file.size >= 2 && file.data[0] == 0x1f && file.data[1] == 0x8b) return readSpz(file, options);
    throw SplatFileError("is neither a .ply nor a .spz file");
}

SplatCloud readSplatFile(const std::string& path, const SplatReadOptions& options) {
    const MappedFile file(path);
    return readSplats(file.bytes(), options);
}

} // namespace hipr
