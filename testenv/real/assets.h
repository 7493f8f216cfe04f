/// @file assets.h
/// Where the real scenes are.
#pragma once

#include <cstdlib>
#include <string>

namespace hipr::test {

/// The environment variable HIPR_ASSETS, else the folder CMake was told.
inline std::string assetsFolder() {
    const char* folder = std::getenv("HIPR_ASSETS");
    return folder ? folder : HIPR_ASSETS;
}

} // namespace hipr::test
