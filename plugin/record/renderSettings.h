/// @file renderSettings.h
/// Render settings by name and as text, typed by the descriptors of the renderer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pxr/imaging/hd/renderDelegate.h"

namespace hipr::record {

/// Sets a render setting. `key` is the setting's key, or its last part when that is unique ("maxDepth" for
/// "hipr:maxDepth"). Throws Failure with ExitUsage for an unknown key (and lists the known ones), for text
/// that is not of the setting's type, and for a value the renderer refuses.
void applySetting(PXR_NS::HdRenderDelegate& delegate, const std::string& key, const std::string& text);

/// Sets a render setting, if the renderer has it and no one of `chosen` sets it: keys with texts, as for
/// applySetting.
void applyDefault(PXR_NS::HdRenderDelegate& delegate, const std::string& key, const std::string& text,
                  const std::vector<std::pair<std::string, std::string>>& chosen);

/// Whether the renderer describes a setting of this key.
bool hasSetting(const PXR_NS::HdRenderDelegate& delegate, const std::string& key);

/// One line per setting: key, type, current value, label.
std::string describeSettings(const PXR_NS::HdRenderDelegate& delegate);

/// All settings as "key=value", separated by single spaces.
std::string settingsSummary(const PXR_NS::HdRenderDelegate& delegate);

} // namespace hipr::record
