#include "renderer/api/settings.h"

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <type_traits>

namespace hipr {
namespace {

std::vector<std::string> splitChoices(const char* text) {
    std::vector<std::string> choices;
    std::stringstream stream(text);
    for (std::string choice; std::getline(stream, choice, '|');)
        choices.push_back(choice);
    return choices;
}

std::vector<SettingInfo> buildTable() {
    return {
#define HIPR_SETTING_INT(member, name, label, def, lo, hi, help)                                             \
    SettingInfo{name, label, help, int(def), double(lo), double(hi), {}},
#define HIPR_SETTING_FLOAT(member, name, label, def, lo, hi, help)                                           \
    SettingInfo{name, label, help, float(def), double(lo), double(hi), {}},
#define HIPR_SETTING_BOOL(member, name, label, def, help) SettingInfo{name, label, help, bool(def), 0, 1, {}},
#define HIPR_SETTING_ENUM(member, name, label, def, choices, help)                                           \
    SettingInfo{name, label, help, std::string(def), 0, 0, splitChoices(choices)},
#include "schemas/settings.def"
#undef HIPR_SETTING_INT
#undef HIPR_SETTING_FLOAT
#undef HIPR_SETTING_BOOL
#undef HIPR_SETTING_ENUM
    };
}

/// Calls `visit` with the named member; returns whether the name exists.
template <class S, class Visitor> bool visitMember(S& settings, const std::string& wanted, Visitor&& visit) {
#define HIPR_VISIT(member, name)                                                                             \
    if (wanted == name) {                                                                                    \
        visit(settings.member);                                                                              \
        return true;                                                                                         \
    }
#define HIPR_SETTING_INT(member, name, label, def, lo, hi, help) HIPR_VISIT(member, name)
#define HIPR_SETTING_FLOAT(member, name, label, def, lo, hi, help) HIPR_VISIT(member, name)
#define HIPR_SETTING_BOOL(member, name, label, def, help) HIPR_VISIT(member, name)
#define HIPR_SETTING_ENUM(member, name, label, def, choices, help) HIPR_VISIT(member, name)
#include "schemas/settings.def"
#undef HIPR_SETTING_INT
#undef HIPR_SETTING_FLOAT
#undef HIPR_SETTING_BOOL
#undef HIPR_SETTING_ENUM
#undef HIPR_VISIT
    return false;
}

const SettingInfo& infoOf(const std::string& name) {
    for (const SettingInfo& info : settingTable())
        if (name == info.name) return info;
    std::abort(); // only called with names visitMember() knows
}

bool parseNumber(const std::string& text, double& number) {
    if (text == "true" || text == "on" || text == "yes") return number = 1, true;
    if (text == "false" || text == "off" || text == "no") return number = 0, true;
    char* end = nullptr;
    number = std::strtod(text.c_str(), &end);
    return !text.empty() && *end == 0;
}

bool toNumber(const SettingValue& value, double& number) {
    if (auto text = std::get_if<std::string>(&value)) return parseNumber(*text, number);
    if (auto b = std::get_if<bool>(&value)) number = *b;
    if (auto i = std::get_if<int>(&value)) number = *i;
    if (auto f = std::get_if<float>(&value)) number = *f;
    return true;
}

bool convert(const SettingInfo&, const SettingValue& value, bool& out, std::string& error) {
    double number = 0;
    if (!toNumber(value, number) || std::isnan(number)) return error = "expects true or false", false;
    out = number != 0;
    return true;
}

template <class T>
bool convert(const SettingInfo& info, const SettingValue& value, T& out, std::string& error) {
    double number = 0;
    if (!toNumber(value, number)) return error = "expects a number", false;
    if (std::is_integral_v<T> && number != std::floor(number)) return error = "expects a whole number", false;
    if (!(number >= info.minimum && number <= info.maximum)) {
        std::ostringstream text;
        text << "must be within " << info.minimum << " and " << info.maximum;
        return error = text.str(), false;
    }
    out = T(number);
    return true;
}

bool convert(const SettingInfo& info, const SettingValue& value, std::string& out, std::string& error) {
    const auto* text = std::get_if<std::string>(&value);
    error = "expects one of";
    for (const std::string& choice : info.choices) {
        if (text && *text == choice) return out = choice, true;
        error += " " + choice;
    }
    return false;
}

} // namespace

bool Settings::operator==(const Settings& o) const {
    for (const SettingInfo& info : settingTable())
        if (readSetting(*this, info.name) != readSetting(o, info.name)) return false;
    return true;
}

const std::vector<SettingInfo>& settingTable() {
    static const std::vector<SettingInfo> table = buildTable();
    return table;
}

bool assignSetting(Settings& settings, const std::string& name, const SettingValue& value, bool* changed,
                   std::string* error) {
    std::string reason;
    bool differs = false;
    const bool known = visitMember(settings, name, [&](auto& member) {
        auto converted = member;
        if (!convert(infoOf(name), value, converted, reason)) return;
        reason.clear();
        differs = converted != member;
        member = converted;
    });
    if (!known) reason = "is not a render setting";
    if (error) *error = reason.empty() ? reason : name + " " + reason;
    if (changed) *changed = differs;
    return reason.empty();
}

SettingValue readSetting(const Settings& settings, const std::string& name) {
    SettingValue value;
    visitMember(settings, name, [&](const auto& member) { value = member; });
    return value;
}

} // namespace hipr
