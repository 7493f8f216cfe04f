/// @file picture.h
/// All AOVs of a picture, and how two of them differ.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hipr::test {

struct Layer {
    std::string aov;
    unsigned components = 1;
    bool integer = false;
    std::vector<uint32_t> words; ///< rows bottom-up
};

/// The lines of a dump, without what only a running viewer may know of: materials that nothing uses, which
/// UsdImaging keeps once it has met them, and hidden objects, which Hydra does not sync while their purpose
/// hides them.
std::string usedFacts(const std::string& dump);

struct Picture {
    int width = 0, height = 0;
    std::vector<Layer> layers;
    std::vector<std::string> prims; ///< by pixel, the scene's prim that is seen first, or empty
    std::string scene;              ///< what the renderer holds, as sorted lines of facts

    /// Empty when every bit is the same; else the AOVs that differ, in how many pixels, and the first of
    /// them. Ids that Hydra numbers as it likes (primId) must be compared as `prims`, and are no layer.
    std::string differenceTo(const Picture& other) const;
    /// Writes the color as a PPM, to look at.
    void save(const std::string& path) const;
};

} // namespace hipr::test
