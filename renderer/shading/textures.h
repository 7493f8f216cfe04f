/// @file textures.h
/// Texture files as TextureRecords with levels of detail: loaded once per (path, colour space, projection,
/// use), shared, freed when unused, within a limit of device memory.
#pragma once

#include <memory>
#include <string>

#include "renderer/api/light.h"
#include "renderer/api/material.h"
#include "renderer/color/color.h"
#include "renderer/shading/image.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/material.h"
#include "shaders/shared/scene.h"

namespace hipr {

/// What a texture is loaded from. Two equal requests share their texels; requests that differ in wrap mode
/// alone share texels too but have records of their own.
struct TextureRequest {
    std::string path; ///< may hold `<UDIM>`
    std::string colorSpace = "auto";
    WrapMode wrapS = WrapMode::UseMetadata, wrapT = WrapMode::UseMetadata;
    bool keepPixels = false; ///< of a light: in full, without coarser levels, and with a host copy for
                             ///< TextureStore::image() until releasePixels()
    DomeFormat format = DomeFormat::LatLong; ///< pictures in others are loaded as latitude-longitude ones
    bool operator<(const TextureRequest& o) const;
};

/// Records of one texture: `first` into the record table, and 0 (ordinary) or the number of UDIM tiles,
/// tile 1001 + i being record first + i.
struct TextureRange {
    uint32_t first = 0;
    uint32_t udimTiles = 0;
};

/// Owns all texels. Used by one thread (commit); loads on many, so the AssetReader is called from several
/// threads at once.
///
/// Order of a commit: MaterialTable and LightTable `set` and `remove`, then TextureStore::commit(), then the
/// tables' own commit().
class TextureStore {
public:
    TextureStore(Device& device, AssetReader assets, std::shared_ptr<const ColorManager> color);
    ~TextureStore();

    /// A number for the texture, stable while acquired. `subject` is named in the message if loading fails.
    /// Cheap: nothing is read before commit().
    uint32_t acquire(const TextureRequest& request, const std::string& subject);
    /// Gives up one acquire(). Texels go with the last one, at the next commit().
    void release(uint32_t texture);

    /// How much device memory textures may take; 0, the default: half of the device's. When all take more,
    /// those whose finest levels are largest go without (see fitTextures()), which is told once. From the
    /// next commit() on.
    void setLimit(uint64_t bytes);

    /// Loads what was acquired since the last commit, in parallel, frees what nobody uses, and uploads the
    /// record table if it changed. Each unreadable file gives one message and TEXEL_NONE records. Returns
    /// whether the record table changed: ranges and its address may then be new. No submission may be reading
    /// the tables.
    bool commit();

    /// Where a texture's records are. Valid after commit().
    TextureRange range(uint32_t texture) const;

    /// Counts the changes of the record table.
    uint32_t version() const;

    /// Whether alpha is known to be 1 all over the texture. Valid after commit().
    bool opaque(uint32_t texture) const;

    /// Host pixels of a texture acquired with keepPixels, or null when it could not be read. Valid after
    /// commit().
    const Image* image(uint32_t texture) const;
    void releasePixels(uint32_t texture);

    /// What reads files.
    const AssetReader& assets() const;

    /// Fills SceneRecord::textures.
    void describe(gpu::SceneRecord& scene) const;

private:
    struct Impl;
    std::unique_ptr<Impl> _impl;
};

} // namespace hipr
