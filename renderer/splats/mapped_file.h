/// @file mapped_file.h
/// A file as memory.
#pragma once

#include <string>

#include "renderer/splats/splat_file.h"

namespace hipr {

/// Maps a file for reading; pages come in as they are read and can be dropped again.
class MappedFile {
public:
    /// @throws SplatFileError when the file cannot be opened or is none
    explicit MappedFile(const std::string& path);
    ~MappedFile();
    MappedFile(const MappedFile&) = delete;
    MappedFile& operator=(const MappedFile&) = delete;

    ByteView bytes() const { return _bytes; }

private:
    ByteView _bytes;
};

} // namespace hipr
