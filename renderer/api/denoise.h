/// @file denoise.h
/// Pictures of few samples -> pictures without noise, by Open Image Denoise 2 where it is installed. The
/// library is looked for at run time: neither a build nor any other picture needs it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hipr {

/// A picture to denoise, and what helps to tell its edges from its noise. Rows in any order, the same in all.
struct NoisyPicture {
    uint32_t width = 0, height = 0;
    std::vector<float> color;  ///< 4 a pixel: scene-linear, premultiplied; alpha is left as it is
    std::vector<float> albedo; ///< 3 a pixel, 0..1 (AovKind::Albedo), or empty
    std::vector<float> normal; ///< 3 a pixel, -1..1 (AovKind::Normal), or empty. Only with an albedo
};

/// Open Image Denoise on the processor. To be used by one thread at a time.
class Denoiser {
public:
    enum class Outcome { Done, Stopped, Failed };

    /// Loads the library: $HIPR_OIDN_LIBRARY, a file or the folder it lies in, else libOpenImageDenoise.so.2
    /// where the system looks for libraries. Null, with the reason and what to do in `error`, where it cannot
    /// be used. Threads as Settings::threadLimit says: 0 for all, -1 for all but one.
    static std::unique_ptr<Denoiser> create(int threadLimit, std::string* error);
    /// Why the library cannot be loaded, and what to do; empty where it can. It stays loaded.
    static std::string missing();
    virtual ~Denoiser() = default;

    /// Replaces the colours of a picture. `stop` is asked again and again, from any thread; once it says true
    /// the outcome is Stopped. That or Failed, with the reason in `error`, leaves any colours.
    virtual Outcome denoise(NoisyPicture& picture, const std::function<bool()>& stop, std::string* error) = 0;
};

} // namespace hipr
