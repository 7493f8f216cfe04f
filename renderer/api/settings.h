/// @file settings.h
/// Render settings as a struct, generated from schemas/settings.def.
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace hipr {

/// Render settings with their defaults. Names, ranges and help live in schemas/settings.def.
struct Settings {
#define HIPR_SETTING_INT(member, name, label, def, lo, hi, help) int member = def;
#define HIPR_SETTING_FLOAT(member, name, label, def, lo, hi, help) float member = def;
#define HIPR_SETTING_BOOL(member, name, label, def, help) bool member = def;
#define HIPR_SETTING_ENUM(member, name, label, def, choices, help) std::string member = def;
#include "schemas/settings.def"
#undef HIPR_SETTING_INT
#undef HIPR_SETTING_FLOAT
#undef HIPR_SETTING_BOOL
#undef HIPR_SETTING_ENUM
    bool operator==(const Settings& o) const;
};

using SettingValue = std::variant<bool, int, float, std::string>;

/// One row of the settings table.
struct SettingInfo {
    const char* name;
    const char* label;
    const char* help;
    SettingValue defaultValue;
    double minimum = 0, maximum = 0;  ///< numbers only
    std::vector<std::string> choices; ///< enums only
};

const std::vector<SettingInfo>& settingTable();

/// Assigns by name. Numbers convert between int, float and bool; text is parsed. Returns false, with the reason in
/// `error`, for an unknown name, a wrong type or a value outside its range. `changed` tells whether the value differs.
bool assignSetting(Settings& settings, const std::string& name, const SettingValue& value, bool* changed,
                   std::string* error);
/// The value of a setting by name; `false` for an unknown name.
SettingValue readSetting(const Settings& settings, const std::string& name);

} // namespace hipr
