/// @file host_texture.h
/// Textures read on the host, for what is computed before anything is traced.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/api/material.h"
#include "renderer/color/color.h"
#include "renderer/shading/image.h"

namespace hipr {

/// The texels of one file, or of the tiles of one UDIM set. Immutable; any number of threads may read.
class HostTexture {
public:
    /// Reads the file; one that cannot be read gives one message that names `subject`.
    HostTexture(const TextureDesc& desc, const AssetReader& assets, const ColorManager& color,
                const MessageSink& messages, const std::string& subject);

    /// The value of a UsdUVTexture node at texture coordinates that have not been transformed yet: as the
    /// kernels' sampleTextureNode() gives it. `desc` may differ from the one it was read for in all but path
    /// and colour space.
    glm::vec4 sample(const TextureDesc& desc, glm::vec2 st) const;

private:
    bool _udim;
    std::map<uint32_t, Image> _tiles; ///< by number, 0 for an ordinary texture
};

} // namespace hipr
