/// @file color.h
/// Colour spaces of textures, by OpenColorIO. The rendering space is linear Rec.709 (D65).
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "renderer/api/types.h"

namespace hipr {

/// What must be done to the stored values of a texture to reach the rendering space.
enum class TexelTransfer {
    Linear, ///< nothing (raw, or already linear Rec.709)
    Srgb,   ///< the sRGB curve: kernels do it, 8-bit texels stay 8-bit
    Convert ///< ColorManager::convert() on the host, to float
};

/// The colour spaces of one OpenColorIO configuration: the file $OCIO names, else the built-in one of
/// builtinColorConfig(). Immutable and thread-safe.
class ColorManager {
public:
    /// Never null. A $OCIO file that cannot be read gives one message and the built-in configuration.
    static std::shared_ptr<const ColorManager> create(const MessageSink& messages);
    ~ColorManager();

    /// Resolves a UsdUVTexture sourceColorSpace: "auto" is sRGB for 8-bit pictures with 3 or 4 channels and
    /// raw for all others (UsdPreviewSurface Specification 2.6, UsdUVTexture), "raw" and "sRGB" mean
    /// themselves in any configuration, anything else names a colour space, role or alias of the
    /// configuration. Unknown names give one message each and count as "auto".
    TexelTransfer transfer(const std::string& colorSpace, bool eightBit, int channels) const;

    /// Converts `pixels` RGBA values in place to the rendering space; alpha stays. Only for spaces for which
    /// transfer() says Convert.
    void convert(const std::string& colorSpace, float* rgba, size_t pixels) const;

private:
    friend class ViewTransform;
    ColorManager();
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

/// The text of the built-in OpenColorIO configuration.
const char* builtinColorConfig();

} // namespace hipr
