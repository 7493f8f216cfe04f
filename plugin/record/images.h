/// @file images.h
/// Image files: multi-layer EXR, and PNG/JPEG through a view transform.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/color/view.h"

namespace hipr::record {

/// One AOV as pixels, top row first, components interleaved.
struct Layer {
    std::string aov;
    int components = 0;
    bool integer = false;
    std::vector<uint32_t> words; ///< float bits, or two's complement ints: width * height * components
    std::string name = {};       ///< of its channels in an EXR; empty: that of the AOV
    bool half = false;           ///< whether an EXR has 16 bits of it, where it is a colour
    const float* floats() const { return reinterpret_cast<const float*>(words.data()); }
};

/// What an EXR header says about a picture.
struct PictureInfo {
    std::string software, scene, camera, settings;
    double frame = 0;
    float worldToCamera[16] = {}, worldToNdc[16] = {}; ///< row vectors, as OpenEXR and OpenUSD write them
    long samples = 0;
    double seconds = 0;
    int x = 0, y = 0; ///< where the pixels begin in the full picture, from its top left
    int fullWidth = 0, fullHeight = 0;
    float pixelAspect = 1;                                      ///< width over height of a pixel
    std::map<std::string, std::vector<std::string>> names = {}; ///< in the manifest of a Cryptomatte AOV
};

struct Picture {
    int width = 0, height = 0;
    std::vector<Layer> layers;
    PictureInfo info;
    const Layer* find(const std::string& aov) const;
    /// What PNG and JPEG files show: the layer named color, else the AOV color, else denoised.
    const Layer* shown() const;
};

/// Kinds of files by extension: "exr", "png", "jpg" (also "jpeg"), in any case; empty for anything else.
std::string imageKind(const std::string& path);

/// Whether a file can be created at `path`; tried by creating its temporary file. Empty, or the reason why
/// not.
std::string whyNotWritable(const std::string& path);

/// How PNG and JPEG files are made.
struct DisplayOptions {
    std::shared_ptr<const ViewTransform> view;
    bool alpha = false; ///< PNG: keep the background transparent instead of black
};

/// Writes all layers (EXR) or the one that is shown (PNG, JPEG). The file appears under its name only when it
/// is complete. Integer layers become UINT channels, in which a miss (-1) reads 4294967295. Throws Failure
/// with ExitOutput. Layers of 16 bits are clamped to +-65504, as far as they are finite.
void writePicture(const std::string& path, const Picture& picture, const DisplayOptions& display);

} // namespace hipr::record
