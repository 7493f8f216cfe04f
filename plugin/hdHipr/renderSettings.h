/// @file renderSettings.h
/// Hydra's render settings <-> the one settings table (schemas/settings.def).
#pragma once

#include "plugin/hdHipr/compat.h"
#include "renderer/api/settings.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

/// One descriptor per row of the table, typed bool, int, float or string.
HdRenderSettingDescriptorList settingDescriptors();

/// What came of assigning a render setting.
enum class SettingResult {
    Unknown,   ///< not in the table
    Refused,   ///< in the table, but the value has a wrong type or range; reported
    Unchanged, ///< the settings hold this value already
    Changed,
};

/// Assigns a Hydra value (bool, any integer, float, double, token or string) to a setting of the table.
SettingResult assignRenderSetting(hipr::Settings& settings, TfToken const& key, VtValue const& value);

/// The current value as a descriptor would give it, or an empty value for an unknown key.
VtValue readRenderSetting(hipr::Settings const& settings, TfToken const& key);

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
