/// @file picture_file.h
/// Pictures to be read as textures.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace hipr::test {

/// A picture file, removed with this.
class PictureFile {
public:
    /// `grey` of column and row, 0..255.
    template <class Grey>
    PictureFile(const std::string& name, uint32_t side, Grey grey)
        : _path(std::filesystem::temp_directory_path() /
                ("hipr-" + std::to_string(getpid()) + "-" + name + ".ppm")) {
        write(side, grey);
    }
    ~PictureFile() { std::filesystem::remove(_path); }
    std::string path() const { return _path.string(); }

    /// Replaces the picture.
    template <class Grey> void write(uint32_t side, Grey grey) const {
        std::ofstream out(_path, std::ios::binary);
        out << "P6\n" << side << " " << side << "\n255\n";
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x)
                out << std::string(3, char(grey(x, y)));
    }

private:
    std::filesystem::path _path;
};

} // namespace hipr::test
