#include "plugin/hdHipr/renderSettings.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "plugin/hdHipr/messages.h"

PXR_NAMESPACE_OPEN_SCOPE

namespace hdhipr {

namespace {

VtValue toVt(hipr::SettingValue const& value) {
    return std::visit([](auto const& v) { return VtValue(v); }, value);
}

int clampToInt(double value) {
    return int(
        std::clamp(value, double(std::numeric_limits<int>::min()), double(std::numeric_limits<int>::max())));
}

/// Hosts hand over whatever their UI or scene file holds: usdview sends int and float, Houdini long and
/// double, UsdRender attributes tokens.
std::optional<hipr::SettingValue> fromVt(VtValue const& value) {
    using Value = hipr::SettingValue;
    if (value.IsHolding<bool>()) {
        return Value(value.UncheckedGet<bool>());
    }
    if (value.IsHolding<int>()) {
        return Value(value.UncheckedGet<int>());
    }
    if (value.IsHolding<float>()) {
        return Value(value.UncheckedGet<float>());
    }
    if (value.IsHolding<std::string>()) {
        return Value(value.UncheckedGet<std::string>());
    }
    if (value.IsHolding<TfToken>()) {
        return Value(value.UncheckedGet<TfToken>().GetString());
    }
    if (value.IsHolding<double>()) {
        return Value(float(value.UncheckedGet<double>()));
    }
    if (value.IsHolding<unsigned>()) {
        return Value(clampToInt(value.UncheckedGet<unsigned>()));
    }
    if (value.IsHolding<int64_t>()) {
        return Value(clampToInt(double(value.UncheckedGet<int64_t>())));
    }
    if (value.IsHolding<uint64_t>()) {
        return Value(clampToInt(double(value.UncheckedGet<uint64_t>())));
    }
    return std::nullopt;
}

bool inTable(TfToken const& key) {
    const auto& table = hipr::settingTable();
    return std::any_of(table.begin(), table.end(), [&](auto const& row) { return key == row.name; });
}

} // namespace

HdRenderSettingDescriptorList settingDescriptors() {
    HdRenderSettingDescriptorList list;
    for (hipr::SettingInfo const& row : hipr::settingTable()) {
        list.push_back({row.label, TfToken(row.name), toVt(row.defaultValue)});
    }
    return list;
}

SettingResult assignRenderSetting(hipr::Settings& settings, TfToken const& key, VtValue const& value) {
    if (!inTable(key)) {
        return SettingResult::Unknown;
    }
    const std::optional<hipr::SettingValue> converted = fromVt(value);
    if (!converted) {
        warnOnce("", "render setting '" + key.GetString() + "' cannot take a value of type " +
                         value.GetTypeName());
        return SettingResult::Refused;
    }
    bool changed = false;
    std::string error;
    if (!hipr::assignSetting(settings, key.GetString(), *converted, &changed, &error)) {
        warnOnce("", "render setting " + error);
        return SettingResult::Refused;
    }
    return changed ? SettingResult::Changed : SettingResult::Unchanged;
}

VtValue readRenderSetting(hipr::Settings const& settings, TfToken const& key) {
    return inTable(key) ? toVt(hipr::readSetting(settings, key.GetString())) : VtValue();
}

} // namespace hdhipr

PXR_NAMESPACE_CLOSE_SCOPE
