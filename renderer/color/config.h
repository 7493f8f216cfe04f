/// @file config.h
/// The OpenColorIO configuration behind ColorManager and ViewTransform; the only header that shows
/// OpenColorIO.
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <OpenColorIO/OpenColorIO.h>

#include "renderer/color/color.h"

namespace hipr {

namespace ocio = OCIO_NAMESPACE;

/// Processors applied one after another.
using ColorChain = std::vector<ocio::ConstCPUProcessorRcPtr>;

void applyChain(const ColorChain& chain, float* rgba, size_t pixels);

struct ColorManager::Impl {
    ocio::ConstConfigRcPtr config;  ///< what users name spaces, displays and views of
    ocio::ConstConfigRcPtr builtin; ///< ours
    /// The rendering space in `config`; empty when it has none, and the way leads over the role
    /// aces_interchange.
    std::string rendering;
    MessageSink messages;

    mutable std::mutex mutex;
    mutable std::map<std::string, ColorChain> toRendering; ///< by colour space
    mutable std::set<std::string> reported;                ///< unknown names

    /// From a space of `config` to the rendering space. Throws ocio::Exception.
    ColorChain chainFrom(const std::string& space) const;
    /// From the rendering space to the nearest space of `config`, which is named in `reached`.
    ColorChain chainInto(std::string& reached) const;
};

} // namespace hipr
