#include "plugin/record/renderSettings.h"

#include <algorithm>
#include <cstdlib>

#include "plugin/record/failure.h"
#include "pxr/base/tf/stringUtils.h"
#include "pxr/base/tf/token.h"
#include "pxr/base/vt/value.h"

PXR_NAMESPACE_USING_DIRECTIVE

namespace hipr::record {

namespace {

std::string lastPart(const std::string& key) {
    return key.substr(key.find_last_of(':') + 1);
}

/// Edit distance (Levenshtein, dynamic programming over one row).
size_t distance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    for (size_t j = 0; j <= b.size(); ++j)
        row[j] = j;
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t above = row[j];
            row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
            diagonal = above;
        }
    }
    return row[b.size()];
}

[[noreturn]] void failUnknown(const HdRenderSettingDescriptorList& known, const std::string& key) {
    std::string message = "the renderer has no setting '" + key + "'.";
    size_t best = key.size() / 2 + 1;
    std::string nearest;
    for (const HdRenderSettingDescriptor& setting : known)
        for (const std::string& name : {setting.key.GetString(), lastPart(setting.key.GetString())})
            if (const size_t d = distance(name, key); d < best) {
                best = d;
                nearest = setting.key.GetString();
            }
    if (!nearest.empty()) message += " Did you mean '" + nearest + "'?";
    message += " Known settings:";
    for (const HdRenderSettingDescriptor& setting : known)
        message += "\n  " + setting.key.GetString();
    throw Failure(ExitUsage, message);
}

HdRenderSettingDescriptor findSetting(const HdRenderDelegate& delegate, const std::string& key) {
    const HdRenderSettingDescriptorList known = delegate.GetRenderSettingDescriptors();
    for (const HdRenderSettingDescriptor& setting : known)
        if (setting.key == key) return setting;
    std::vector<HdRenderSettingDescriptor> matches;
    for (const HdRenderSettingDescriptor& setting : known)
        if (lastPart(setting.key.GetString()) == key) matches.push_back(setting);
    if (matches.size() != 1) failUnknown(known, key);
    return matches.front();
}

VtValue parseBool(const std::string& text) {
    for (const char* yes : {"1", "true", "on", "yes"})
        if (text == yes) return VtValue(true);
    for (const char* no : {"0", "false", "off", "no"})
        if (text == no) return VtValue(false);
    return VtValue();
}

VtValue parseInt(const std::string& text) {
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    return text.empty() || *end != '\0' || long(int(value)) != value ? VtValue() : VtValue(int(value));
}

VtValue parseDouble(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return text.empty() || *end != '\0' ? VtValue() : VtValue(value);
}

/// The text as a value of the type of `like`; empty when it is none.
VtValue parseLike(const VtValue& like, const std::string& text) {
    if (like.IsHolding<bool>()) return parseBool(text);
    if (like.IsHolding<std::string>()) return VtValue(text);
    if (like.IsHolding<TfToken>()) return VtValue(TfToken(text));
    const VtValue number =
        like.IsHolding<float>() || like.IsHolding<double>() ? parseDouble(text) : parseInt(text);
    return VtValue::CastToTypeOf(number, like);
}

std::string typeName(const VtValue& value) {
    if (value.IsHolding<bool>()) return "bool";
    if (value.IsHolding<float>() || value.IsHolding<double>()) return "float";
    if (value.IsHolding<std::string>() || value.IsHolding<TfToken>()) return "text";
    return value.CanCast<int>() ? "int" : value.GetTypeName();
}

VtValue currentValue(const HdRenderDelegate& delegate, const HdRenderSettingDescriptor& setting) {
    const VtValue value = delegate.GetRenderSetting(setting.key);
    return value.IsEmpty() ? setting.defaultValue : value;
}

} // namespace

void applySetting(HdRenderDelegate& delegate, const std::string& key, const std::string& text) {
    const HdRenderSettingDescriptor setting = findSetting(delegate, key);
    const VtValue value = parseLike(setting.defaultValue, text);
    if (value.IsEmpty())
        throw Failure(ExitUsage,
                      "setting '" + key + "': '" + text + "' is no " + typeName(setting.defaultValue));
    delegate.SetRenderSetting(setting.key, value);
    const VtValue now = VtValue::CastToTypeOf(currentValue(delegate, setting), value);
    if (now != value) throw Failure(ExitUsage, "setting '" + key + "': the renderer refuses '" + text + "'");
}

void applyDefault(HdRenderDelegate& delegate, const std::string& key, const std::string& text,
                  const std::vector<std::pair<std::string, std::string>>& chosen) {
    const bool set = std::any_of(chosen.begin(), chosen.end(), [&](const auto& setting) {
        return setting.first == key || setting.first == lastPart(key);
    });
    if (!set && hasSetting(delegate, key)) applySetting(delegate, key, text);
}

bool hasSetting(const HdRenderDelegate& delegate, const std::string& key) {
    const HdRenderSettingDescriptorList known = delegate.GetRenderSettingDescriptors();
    return std::any_of(known.begin(), known.end(), [&](const auto& setting) { return setting.key == key; });
}

std::string describeSettings(const HdRenderDelegate& delegate) {
    std::string text;
    for (const HdRenderSettingDescriptor& setting : delegate.GetRenderSettingDescriptors())
        text += TfStringPrintf("%-32s %-6s %-16s %s\n", setting.key.GetText(),
                               typeName(setting.defaultValue).c_str(),
                               TfStringify(currentValue(delegate, setting)).c_str(), setting.name.c_str());
    return text;
}

std::string settingsSummary(const HdRenderDelegate& delegate) {
    std::string text;
    for (const HdRenderSettingDescriptor& setting : delegate.GetRenderSettingDescriptors())
        text += (text.empty() ? "" : " ") + setting.key.GetString() + "=" +
                TfStringify(currentValue(delegate, setting));
    return text;
}

} // namespace hipr::record
