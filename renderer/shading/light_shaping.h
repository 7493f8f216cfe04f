/// @file light_shaping.h
/// LightShaping -> ShapingRecord; shaders/light/shaping.glsl applies it.
#pragma once

#include <map>
#include <string>

#include "renderer/api/light.h"
#include "renderer/shading/ies_profile.h"
#include "renderer/vulkan/device.h"
#include "shaders/shared/light.h"

namespace hipr {

/// IES profiles on the device, one for each file in use. A file that cannot be used gives one message.
class ProfileStore {
public:
    ProfileStore(Device& device, AssetReader assets) : _device(device), _assets(std::move(assets)) {}

    struct Entry {
        IesProfile profile;
        Buffer values; ///< none: the file cannot be used
        bool used = false;
    };
    /// The profile of a file, read when it is asked for the first time; null if it cannot be used. `subject`
    /// is named in the message.
    const Entry* find(const std::string& path, const std::string& subject);
    /// Frees the profiles that were not asked for since the last call.
    void dropUnused();
    /// Frees all. Returns whether there were any.
    bool forget();

private:
    Device& _device;
    AssetReader _assets;
    std::map<std::string, Entry> _entries;
};

/// Whether a light is shaped at all.
bool isShaped(const LightShaping& shaping);

/// `profile`: of shaping.iesFile, or null.
gpu::ShapingRecord describeShaping(const LightShaping& shaping, const ProfileStore::Entry* profile);

/// The share of its unshaped power that a light sends, over all directions alike, or, `flat`, by the cosine
/// of the direction to -Z.
double shapedShare(const gpu::ShapingRecord& shaping, const ProfileStore::Entry* profile, bool flat);

} // namespace hipr
